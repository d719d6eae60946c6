#include "hw/link/dds_domain.hpp"

#include <dds/dds.h>
#include <fmt/format.h>

#include <map>
#include <mutex>

#include "hw/link/link_error.hpp"

namespace hogline::hw::link {
namespace {

struct OpenDomains {
  std::mutex mutex;
  std::map<std::uint32_t, std::weak_ptr<DdsDomain>> by_number;
};

OpenDomains& open_domains() {
  static OpenDomains domains;
  return domains;
}

}  // namespace

std::shared_ptr<DdsDomain> DdsDomain::open(std::uint32_t number, const std::string& xml, bool alone) {
  OpenDomains& domains = open_domains();
  const std::lock_guard lock(domains.mutex);
  if (auto shared = domains.by_number[number].lock()) {
    if (alone || shared->alone_)
      throw LinkError(fmt::format("DDS domain {} with security takes a process for each robot", number));
    if (shared->xml_ == xml) return shared;
    throw LinkError(
        fmt::format("DDS domain {} is open in this process with other addresses or another interface", number));
  }
  std::shared_ptr<DdsDomain> made(new DdsDomain(number, xml, alone));
  domains.by_number[number] = made;
  return made;
}

DdsDomain::DdsDomain(std::uint32_t number, std::string xml, bool alone)
    : number_(number), xml_(std::move(xml)), alone_(alone) {
  handle_ = dds_create_domain(number_, xml_.c_str());
  if (handle_ < 0) throw LinkError(fmt::format("DDS domain {}: {}", number_, dds_strretcode(handle_)));
}

DdsDomain::~DdsDomain() { dds_delete(handle_); }

}  // namespace hogline::hw::link
