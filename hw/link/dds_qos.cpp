#include "hw/link/dds_qos.hpp"

#include <filesystem>

namespace hogline::hw::link {
namespace {

Qos common_qos(const Topic& topic) {
  Qos qos(dds_create_qos());
  dds_qset_reliability(qos.get(), topic.reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT,
                       DDS_MSECS(100));
  dds_qset_durability(qos.get(), topic.for_late_joiners ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, topic.depth);
  return qos;
}

Qos both_ends_qos(const Topic& topic) {
  Qos qos = common_qos(topic);
  if (topic.heartbeat) {
    dds_qset_deadline(qos.get(), heartbeat_deadline.count());
    dds_qset_liveliness(qos.get(), DDS_LIVELINESS_AUTOMATIC, liveliness_lease.count());
  }
  return qos;
}

void set_plugin(dds_qos_t* qos, const std::string& part, const std::string& library, const std::string& function) {
  const std::string key = "dds.sec." + part + ".library.";
  dds_qset_prop(qos, (key + "path").c_str(), (std::string(HOGLINE_DDS_PLUGIN_FOLDER) + "/" + library).c_str());
  dds_qset_prop(qos, (key + "init").c_str(), ("init_" + function).c_str());
  dds_qset_prop(qos, (key + "finalize").c_str(), ("finalize_" + function).c_str());
}

void set_security(dds_qos_t* qos, const LinkConfig& config) {
  set_plugin(qos, "auth", "libdds_security_auth.so", "authentication");
  set_plugin(qos, "crypto", "libdds_security_crypto.so", "crypto");
  set_plugin(qos, "access", "libdds_security_ac.so", "access_control");
  const std::string folder = "file:" + std::filesystem::absolute(config.security->folder).string() + "/";
  const auto set_file = [&](const char* key, const std::string& name) {
    dds_qset_prop(qos, key, (folder + name).c_str());
  };
  set_file("dds.sec.auth.identity_ca", "identity_ca.pem");
  set_file("dds.sec.auth.identity_certificate", config.robot + ".cert.pem");
  set_file("dds.sec.auth.private_key", config.robot + ".key.pem");
  set_file("dds.sec.access.permissions_ca", "permissions_ca.pem");
  set_file("dds.sec.access.governance", "governance.p7s");
  set_file("dds.sec.access.permissions", config.robot + ".permissions.p7s");
}

}  // namespace

Qos participant_qos(const LinkConfig& config) {
  Qos qos(dds_create_qos());
  if (config.security) set_security(qos.get(), config);
  return qos;
}

// ROS 2's readers have the common partition, which has no name.
Qos writer_qos(const Topic& topic, const std::string& robot) {
  Qos qos = both_ends_qos(topic);
  const char* names[] = {"", robot.c_str()};
  if (!robot.empty()) dds_qset_partition(qos.get(), 2, names);
  return qos;
}

std::vector<std::string> names_of(const dds_qos_t* qos) {
  std::uint32_t count = 0;
  char** partitions = nullptr;
  std::vector<std::string> names;
  if (!dds_qget_partition(qos, &count, &partitions)) return names;
  for (std::uint32_t i = 0; i < count; ++i) {
    names.emplace_back(partitions[i]);
    dds_free(partitions[i]);
  }
  dds_free(partitions);
  return names;
}

Qos reader_qos(const Topic& topic) {
  Qos qos = both_ends_qos(topic);
  dds_qset_ignorelocal(qos.get(), DDS_IGNORELOCAL_PARTICIPANT);
  return qos;
}

}  // namespace hogline::hw::link
