// The only file pair that knows libaravis.
#pragma once

#include <memory>

#include "hw/aravis/aravis_config.hpp"
#include "hw/aravis/frame_source.hpp"

namespace hogline::hw {

class AravisSource final : public FrameSource {
 public:
  explicit AravisSource(const AravisConfig& config);
  ~AravisSource() override;

  std::optional<SourceFault> start() override;
  void stop() override;
  std::optional<CameraBuffer> next(Duration patience) override;
  std::size_t waiting() const override;
  bool control_lost() const override;
  const CameraIdentity& identity() const override { return identity_; }

 private:
  struct Session;
  AravisConfig config_;
  CameraIdentity identity_;
  std::unique_ptr<Session> session_;
};

}  // namespace hogline::hw
