// The pan-tilt head on CANopen: two CiA 402 drives in profile position and cyclic synchronous velocity.
#pragma once

#include <array>
#include <optional>

#include "hw/can_bus.hpp"
#include "hw/canopen/axis_pair.hpp"
#include "hw/canopen/head_axis.hpp"
#include "hw/head.hpp"

namespace hogline::hw {

/// Boots by itself from the first step(), and stops for good at any fault, as the wheels do. On a bus that it shares
/// with the wheels its `duties` are false: SYNC and heartbeat are sent once.
class TwoAxisHead final : public Head {
 public:
  /// Throws std::invalid_argument with config_error()'s text. The bus must outlive the head.
  TwoAxisHead(CanBus& bus, const TwoAxisHeadConfig& config);
  TwoAxisHead(const TwoAxisHead&) = delete;
  TwoAxisHead& operator=(const TwoAxisHead&) = delete;

  void step(Stamp now) override;
  HeadState state() const override;
  void enable() override { pair_.enable(); }
  void point(const PanTilt& target, Stamp now) override;
  void track(const PanTiltRate& rates, Stamp now) override;
  void stop() override;
  void rearm() override { pair_.rearm(); }

  const HeadAxis& pan() const { return axes_[0]; }
  const HeadAxis& tilt() const { return axes_[1]; }

 private:
  struct Rates {
    PanTiltRate rates;
    Stamp stamp;
  };

  void follow_rates(Stamp now);
  void send(Stamp now);
  void refuse(const char* what, double pan, double tilt, Stamp now);

  TwoAxisHeadConfig config_;
  std::array<HeadAxis, 2> axes_;
  AxisPair pair_;
  std::optional<Rates> tracking_;
};

}  // namespace hogline::hw
