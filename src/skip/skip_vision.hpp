// Sees what the skip's pictures show. The near view measures the sheet in every picture: acquired once while the head
// stands, then fitted from where body and joints put it. The far view is corrected by the lines that it shows itself.
#pragma once

#include <memory>
#include <optional>

#include "src/config/skip_rig.hpp"
#include "src/skip/skip_seer.hpp"

namespace hogline {

class SkipVision final : public SkipSeer {
 public:
  explicit SkipVision(const config::SkipRig& rig);
  ~SkipVision() override;

  servo::NearSight near_view(const hw::Frame& frame, const servo::HeadAngles& q,
                             const servo::SkipDiagnosis& known) override;
  FarPercept far_view(const hw::Frame& frame, const servo::HeadAngles& q, const servo::SkipDiagnosis& known) override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hogline
