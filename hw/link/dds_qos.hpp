// Qualities of service as Cyclone DDS wants them. Each belongs to its holder.
#pragma once

#include <dds/dds.h>

#include <memory>
#include <string>
#include <vector>

#include "hw/link/link_config.hpp"
#include "hw/link/topics.hpp"

namespace hogline::hw::link {

struct QosDeleter {
  void operator()(dds_qos_t* qos) const { dds_delete_qos(qos); }
};
using Qos = std::unique_ptr<dds_qos_t, QosDeleter>;

/// Of the participant: with the security plugins and this robot's files where the configuration asks for them.
Qos participant_qos(const LinkConfig& config);
/// `robot`: with security, whose name its partitions say beside the common one; empty without.
Qos writer_qos(const Topic& topic, const std::string& robot);
/// The names a writer speaks for, as its partitions say: those that it is permitted, where there is security.
std::vector<std::string> names_of(const dds_qos_t* qos);
/// One's own messages do not come back.
Qos reader_qos(const Topic& topic);

}  // namespace hogline::hw::link
