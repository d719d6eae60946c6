#include "hw/link/team_keys.hpp"

#include <fmt/format.h>
#include <openssl/bio.h>
#include <openssl/err.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/pkcs7.h>
#include <openssl/rand.h>
#include <openssl/x509v3.h>

#include <memory>

#include "hw/link/key_folder.hpp"
#include "hw/link/team_keys_check.hpp"

namespace hogline::hw::link {
namespace {

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

std::string text_of(BIO* bio) {
  char* text = nullptr;
  const long size = BIO_get_mem_data(bio, &text);
  return {text, static_cast<std::size_t>(size)};
}

Bio memory() { return Bio(required(BIO_new(BIO_s_mem()), "memory")); }

std::string key_text(EVP_PKEY* key) {
  const Bio bio = memory();
  require(PEM_write_bio_PrivateKey(bio.get(), key, nullptr, nullptr, 0, nullptr, nullptr) == 1, "writing a key");
  return text_of(bio.get());
}

std::string certificate_text(X509* certificate) {
  const Bio bio = memory();
  require(PEM_write_bio_X509(bio.get(), certificate) == 1, "writing a certificate");
  return text_of(bio.get());
}

// S/MIME with the text in clear beside its signature.
std::string signed_text(const std::string& document, X509* authority, EVP_PKEY* key) {
  const auto text = [&] {
    return Bio(required(BIO_new_mem_buf(document.data(), static_cast<int>(document.size())), "a document"));
  };
  constexpr int flags = PKCS7_DETACHED | PKCS7_TEXT;
  Signature signature(required(PKCS7_sign(authority, key, nullptr, text().get(), flags), "signing a document"));
  const Bio bio = memory();
  require(SMIME_write_PKCS7(bio.get(), signature.get(), text().get(), flags) == 1, "writing a signed document");
  return text_of(bio.get());
}

struct KeyFile {
  std::string name;
  std::string text;
  bool secret = false;
};

std::vector<KeyFile> key_files(const TeamKeysRequest& request) {
  const Key authority_key = new_key();
  const Certificate authority =
      certificate_of("hogline team authority", authority_key.get(), nullptr, nullptr, request);
  const auto sign = [&](const std::string& document) {
    return signed_text(document, authority.get(), authority_key.get());
  };
  std::vector<KeyFile> files{{"identity_ca.pem", certificate_text(authority.get())},
                             {"permissions_ca.pem", certificate_text(authority.get())},
                             {"governance.p7s", sign(governance_xml(request.domain))}};
  const TeamTime begin = request.from - std::chrono::hours{1};
  const TeamTime end = request.from + std::chrono::hours{24} * request.days;
  for (const TeamMember& member : request.members) {
    const Key key = new_key();
    const Certificate certificate =
        certificate_of(member.robot, key.get(), authority.get(), authority_key.get(), request);
    files.push_back({member.robot + ".key.pem", key_text(key.get()), true});
    files.push_back({member.robot + ".cert.pem", certificate_text(certificate.get())});
    files.push_back({member.robot + ".permissions.p7s", sign(permissions_xml(member, request.domain, begin, end))});
  }
  files.push_back({"ca.key.pem", key_text(authority_key.get()), true});
  return files;
}

}  // namespace

void make_team_keys(const TeamKeysRequest& request) {
  check_request(request);
  KeyFolder folder(request.folder);
  for (const KeyFile& file : key_files(request)) folder.add(file.name, file.text, file.secret);
  folder.keep();
}

}  // namespace hogline::hw::link
