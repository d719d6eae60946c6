// The server side of SDO (CiA 301, 7.2.4) of a simulated device: expedited and segmented, both directions.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "hw/can_bus.hpp"
#include "hw/sim/object_dictionary.hpp"

namespace hogline::hw::sim {

class SdoServer {
 public:
  SdoServer(std::uint8_t node, ObjectDictionary& objects) : node_(node), objects_(objects) {}

  /// The answer to a request on 600+node; nothing for an abort or a frame that is no request.
  std::optional<CanFrame> on_request(const CanFrame& request);
  /// Ends a segmented transfer without a word.
  void reset() { transfer_ = Transfer::none; }

 private:
  enum class Transfer { none, upload, download };
  using Data = std::array<std::uint8_t, 8>;

  CanFrame initiate_download(const Data& request);
  CanFrame download_segment(const Data& request);
  CanFrame initiate_upload();
  CanFrame upload_segment(const Data& request);
  CanFrame answer(std::uint8_t command, std::uint32_t value = 0) const;
  CanFrame abort(std::uint32_t code);

  std::uint8_t node_;
  ObjectDictionary& objects_;
  Transfer transfer_ = Transfer::none;
  std::uint16_t index_ = 0;
  std::uint8_t sub_ = 0;
  bool toggle_ = false;
  std::vector<std::uint8_t> data_;
  std::size_t sent_ = 0;
  std::optional<std::uint32_t> announced_;
};

}  // namespace hogline::hw::sim
