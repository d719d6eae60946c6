// A DDS domain of this process. Cyclone DDS has one per number and process; links with the same configuration share it.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace hogline::hw::link {

class DdsDomain {
 public:
  /// Opens it, or shares the open one. Throws LinkError: no such interface, or open with another configuration.
  static std::shared_ptr<DdsDomain> open(std::uint32_t number, const std::string& xml);
  ~DdsDomain();
  DdsDomain(const DdsDomain&) = delete;
  DdsDomain& operator=(const DdsDomain&) = delete;

 private:
  DdsDomain(std::uint32_t number, std::string xml);

  std::uint32_t number_;
  std::string xml_;
  std::int32_t handle_ = 0;
};

}  // namespace hogline::hw::link
