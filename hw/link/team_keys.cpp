#include "hw/link/team_keys.hpp"

#include <fmt/format.h>
#include <openssl/bio.h>
#include <openssl/err.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/pkcs7.h>
#include <openssl/rand.h>
#include <openssl/x509v3.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <set>

#include "hw/link/link_error.hpp"

namespace hogline::hw::link {
namespace {

namespace fs = std::filesystem;

template <auto release>
struct Release {
  template <typename T>
  void operator()(T* held) const {
    release(held);
  }
};
using Key = std::unique_ptr<EVP_PKEY, Release<EVP_PKEY_free>>;
using Certificate = std::unique_ptr<X509, Release<X509_free>>;
using Bio = std::unique_ptr<BIO, Release<BIO_free_all>>;
using Signature = std::unique_ptr<PKCS7, Release<PKCS7_free>>;

// OpenSSL's word for what went wrong, if it has one.
void require(bool fine, const std::string& what) {
  if (fine) return;
  char text[256] = "";
  ERR_error_string_n(ERR_get_error(), text, sizeof text);
  throw LinkError(what + ": " + text);
}

template <typename T>
T* required(T* made, const std::string& what) {
  require(made != nullptr, what);
  return made;
}

void check(const TeamKeysRequest& request) {
  std::set<std::string> names;
  for (const TeamMember& member : request.members) {
    const bool fine = !member.robot.empty() && member.robot.size() <= 64 &&
                      std::all_of(member.robot.begin(), member.robot.end(),
                                  [](unsigned char c) { return std::isalnum(c) != 0 || c == '-' || c == '_'; });
    if (!fine) throw LinkError(fmt::format("'{}' is no name: use letters, digits, - and _", member.robot));
    if (!names.insert(member.robot).second) throw LinkError(fmt::format("two robots are named '{}'", member.robot));
  }
  if (names.empty()) throw LinkError("keys for nobody: name at least one robot");
  if (request.days < 1) throw LinkError("keys must hold for at least one day");
  std::error_code nothing;
  if (fs::exists(fs::path(request.folder) / "ca.key.pem", nothing)) {
    throw LinkError(
        fmt::format("{} holds a team's keys: choose another folder, or remove it if all robots are to get "
                    "new keys",
                    request.folder));
  }
}

Key new_key() { return Key(required(EVP_EC_gen("P-256"), "a new P-256 key")); }

void set_name(X509_NAME* name, const std::string& common_name) {
  require(X509_NAME_add_entry_by_txt(name, "CN", MBSTRING_UTF8,
                                     reinterpret_cast<const unsigned char*>(common_name.c_str()), -1, -1, 0) == 1,
          "naming " + common_name);
}

void set_extension(X509* certificate, int kind, const char* value) {
  X509V3_CTX context;
  X509V3_set_ctx(&context, certificate, certificate, nullptr, nullptr, 0);
  std::unique_ptr<X509_EXTENSION, Release<X509_EXTENSION_free>> extension(
      required(X509V3_EXT_conf_nid(nullptr, &context, kind, value), value));
  require(X509_add_ext(certificate, extension.get(), -1) == 1, value);
}

std::int64_t unix_s(TeamTime time) {
  return std::chrono::duration_cast<std::chrono::seconds>(time.time_since_epoch()).count();
}

// Signed by the authority, or by itself where that is null.
Certificate certificate_of(const std::string& common_name, EVP_PKEY* key, X509* authority, EVP_PKEY* authority_key,
                           const TeamKeysRequest& request) {
  Certificate certificate(required(X509_new(), "a certificate"));
  X509* c = certificate.get();
  X509_set_version(c, X509_VERSION_3);
  std::uint64_t serial = 0;
  require(RAND_bytes(reinterpret_cast<unsigned char*>(&serial), sizeof serial) == 1, "random numbers");
  ASN1_INTEGER_set_uint64(X509_get_serialNumber(c), serial >> 1);
  ASN1_TIME_set(X509_getm_notBefore(c), unix_s(request.from) - 3600);  // the robots' clocks may differ
  ASN1_TIME_set(X509_getm_notAfter(c), unix_s(request.from) + std::int64_t{86400} * request.days);
  set_name(X509_get_subject_name(c), common_name);
  X509_set_issuer_name(c, X509_get_subject_name(authority == nullptr ? c : authority));
  X509_set_pubkey(c, key);
  if (authority == nullptr) {
    set_extension(c, NID_basic_constraints, "critical,CA:TRUE,pathlen:0");
    set_extension(c, NID_key_usage, "critical,keyCertSign,cRLSign,digitalSignature");
  } else {
    set_extension(c, NID_basic_constraints, "critical,CA:FALSE");
    set_extension(c, NID_key_usage, "critical,digitalSignature");
  }
  require(X509_sign(c, authority == nullptr ? key : authority_key, EVP_sha256()) > 0, "signing " + common_name);
  return certificate;
}

Bio file_to_write(const fs::path& path, bool secret) {
  std::error_code failure;
  std::ofstream(path, std::ios::trunc).close();
  fs::permissions(path,
                  secret
                      ? fs::perms::owner_read | fs::perms::owner_write
                      : fs::perms::owner_read | fs::perms::owner_write | fs::perms::group_read | fs::perms::others_read,
                  failure);
  if (failure) throw LinkError(fmt::format("{} can not be written: {}", path.string(), failure.message()));
  return Bio(required(BIO_new_file(path.c_str(), "w"), path.string() + " can not be written"));
}

void write_key(const fs::path& path, EVP_PKEY* key) {
  require(PEM_write_bio_PrivateKey(file_to_write(path, true).get(), key, nullptr, nullptr, 0, nullptr, nullptr) == 1,
          path.string());
}

void write_certificate(const fs::path& path, X509* certificate) {
  require(PEM_write_bio_X509(file_to_write(path, false).get(), certificate) == 1, path.string());
}

// S/MIME with the text in clear beside its signature.
void write_signed(const fs::path& path, const std::string& document, X509* authority, EVP_PKEY* key) {
  const auto text = [&] {
    return Bio(required(BIO_new_mem_buf(document.data(), static_cast<int>(document.size())), path.string()));
  };
  constexpr int flags = PKCS7_DETACHED | PKCS7_TEXT;
  Signature signature(required(PKCS7_sign(authority, key, nullptr, text().get(), flags), "signing " + path.string()));
  require(SMIME_write_PKCS7(file_to_write(path, false).get(), signature.get(), text().get(), flags) == 1,
          path.string());
}

}  // namespace

void make_team_keys(const TeamKeysRequest& request) {
  check(request);
  const fs::path folder = request.folder;
  std::error_code failure;
  fs::create_directories(folder, failure);
  if (failure) throw LinkError(fmt::format("{} can not be made: {}", request.folder, failure.message()));

  const Key authority_key = new_key();
  const Certificate authority =
      certificate_of("hogline team authority", authority_key.get(), nullptr, nullptr, request);
  write_key(folder / "ca.key.pem", authority_key.get());
  write_certificate(folder / "identity_ca.pem", authority.get());
  write_certificate(folder / "permissions_ca.pem", authority.get());
  write_signed(folder / "governance.p7s", governance_xml(request.domain), authority.get(), authority_key.get());

  const TeamTime begin = request.from - std::chrono::hours{1};
  const TeamTime end = request.from + std::chrono::hours{24} * request.days;
  for (const TeamMember& member : request.members) {
    const Key key = new_key();
    write_key(folder / (member.robot + ".key.pem"), key.get());
    write_certificate(folder / (member.robot + ".cert.pem"),
                      certificate_of(member.robot, key.get(), authority.get(), authority_key.get(), request).get());
    write_signed(folder / (member.robot + ".permissions.p7s"), permissions_xml(member, request.domain, begin, end),
                 authority.get(), authority_key.get());
  }
}

}  // namespace hogline::hw::link
