#include "hw/canopen/bus_identifiers.hpp"

#include "hw/canopen/cob_id.hpp"

namespace hogline::hw {

BusIdentifiers bus_identifiers(std::span<const std::uint8_t> nodes, std::uint8_t master_node, BusDuties duties) {
  BusIdentifiers ids;
  ids.own = {nmt_cob_id};
  if (duties.heartbeat) ids.own.push_back(heartbeat_cob_id(master_node));
  if (duties.sync) ids.set_points.push_back(sync_cob_id);
  for (const std::uint8_t node : nodes) {
    for (const std::uint32_t heard : {emergency_cob_id(node), tpdo_cob_id(1, node), tpdo_cob_id(2, node),
                                      sdo_response_cob_id(node), heartbeat_cob_id(node)}) {
      ids.heard.push_back(heard);
    }
    ids.own.push_back(sdo_request_cob_id(node));
    ids.set_points.push_back(rpdo_cob_id(1, node));
    ids.set_points.push_back(rpdo_cob_id(2, node));
  }
  ids.own.insert(ids.own.end(), ids.set_points.begin(), ids.set_points.end());
  return ids;
}

}  // namespace hogline::hw
