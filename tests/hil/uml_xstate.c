/* Preloaded into user-mode-linux (see with_vcan): lets it run on processors with more registers than it knows.
 *
 * The UML kernel of Debian 12 keeps a process's extended registers in a buffer of 2696 bytes (everything up to AVX-512
 * and the protection keys). The host's kernel takes such a set back only whole: 11008 bytes where the processor has AMX
 * tiles. UML's first PTRACE_SETREGSET then fails with EFAULT, and it panics before the first process has run.
 *
 * So a set that is too short is completed from what the process holds. The part that UML leaves out belongs to AMX, which
 * a process must ask its kernel for and UML never grants: nothing is lost. Every other request goes through unchanged. */
#include <elf.h>
#include <errno.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>
#include <sys/ptrace.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

static char whole[1 << 16]; /* UML's kernel is one thread */

static long complete_and_set(int pid, const struct iovec* given) {
  struct iovec all = {whole, sizeof whole};
  if (syscall(SYS_ptrace, PTRACE_GETREGSET, pid, NT_X86_XSTATE, &all) != 0) return -1;
  if (given->iov_len < all.iov_len) memcpy(whole, given->iov_base, given->iov_len);
  const struct iovec* set = given->iov_len < all.iov_len ? &all : given;
  return syscall(SYS_ptrace, PTRACE_SETREGSET, pid, NT_X86_XSTATE, set);
}

long ptrace(enum __ptrace_request request, ...) {
  va_list arguments;
  va_start(arguments, request);
  const int pid = va_arg(arguments, int);
  void* const address = va_arg(arguments, void*);
  void* const data = va_arg(arguments, void*);
  va_end(arguments);

  if (request == PTRACE_SETREGSET && address == (void*)(ptrdiff_t)NT_X86_XSTATE) return complete_and_set(pid, data);
  if (request == PTRACE_PEEKTEXT || request == PTRACE_PEEKDATA || request == PTRACE_PEEKUSER) {
    /* The C library turns the system call's out-parameter into the result. */
    long word = 0;
    if (syscall(SYS_ptrace, request, pid, address, &word) != 0) return -1;
    errno = 0;
    return word;
  }
  return syscall(SYS_ptrace, request, pid, address, data);
}
