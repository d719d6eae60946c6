#include "src/skip/track_recording.hpp"

#include <algorithm>

#include "servo/skip_sheet.hpp"

namespace hogline {
namespace {

constexpr Duration period = std::chrono::milliseconds(5);
constexpr Duration never = std::chrono::hours(24);
constexpr Duration after_last = std::chrono::milliseconds(250);  // whoever recorded it may have stopped in between
constexpr Duration base = std::chrono::seconds(1);               // the epoch stands for "never heard of"

servo::SkipConfig for_recordings(servo::SkipConfig config, const SkipRecording& recording) {
  config.deadlines.look = config.deadlines.aim = config.deadlines.wait = never;
  if (recording.near.frames.empty()) config.ages.pose = never;
  if (recording.far.frames.empty()) config.ages.far = never;
  if (recording.release && config.expected_spin_radps == 0.0) {
    config.expected_spin_radps = recording.release->signal.stone.spin_radps;
  }
  return config;
}

class Player {
 public:
  Player(const SkipRecording& recording, const FrameLoader& load, SkipSeer& seer)
      : recording_(recording), load_(load), seer_(seer) {
    begin_ = end_ = (recording.near.frames.empty() ? recording.far : recording.near).frames.front().time;
    for (const auto* r : {&recording.near, &recording.far}) {
      if (r->frames.empty()) continue;
      begin_ = std::min(begin_, r->frames.front().time);
      end_ = std::max(end_, r->frames.back().time);
    }
  }

  Stamp begin() const { return Stamp{base}; }
  Stamp end() const { return replayed(end_) + after_last; }
  Stamp replayed(Duration time) const { return begin() + (time - begin_); }
  int unread() const { return unread_; }
  int near_frames() const { return static_cast<int>(near_); }
  int far_frames() const { return static_cast<int>(far_); }

  servo::SkipObservation observe(Stamp now, const servo::SkipDiagnosis& known) {
    servo::SkipObservation o;
    o.now = now;
    o.head = head(now);
    if (!told_ && recording_.release && recorded(now) >= recording_.release->heard) {
      told_ = true;
      o.release = recording_.release->signal;
      o.release->stamp = replayed(recording_.release->signal.stamp.time_since_epoch());
    }
    if (const auto f = next(recording_.near, near_, now)) {
      if (const auto q = angles(f->time)) o.near = seer_.near_view(frame(*f), *q, known);
    }
    if (const auto f = next(recording_.far, far_, now)) {
      if (const auto q = angles(f->time)) o.far = seer_.far_view(frame(*f), *q, known);
    }
    return o;
  }

 private:
  Duration recorded(Stamp now) const { return begin_ + (now - begin()); }
  std::optional<servo::HeadAngles> angles(Duration time) const { return angles_at(recording_, time); }

  hw::Frame frame(const hw::files::RecordedFrame& f) {
    hw::Frame loaded = load_(f);
    unread_ += loaded.bgr.empty() ? 1 : 0;
    loaded.id = f.id;
    loaded.stamp = replayed(f.time);
    return loaded;
  }

  static std::optional<hw::files::RecordedFrame> take(const hw::files::Recording& r, std::size_t& at, Duration time) {
    if (at >= r.frames.size() || r.frames[at].time > time) return std::nullopt;
    return r.frames[at++];
  }
  std::optional<hw::files::RecordedFrame> next(const hw::files::Recording& r, std::size_t& at, Stamp now) const {
    return take(r, at, recorded(now));
  }

  servo::HeadObservation head(Stamp now) const {
    servo::HeadObservation h;
    h.enabled = h.on_target = true;
    const Duration time = std::min(recorded(now), end_);
    const auto q = angles(time), before = angles(time - period);
    if (!q) {
      h.error = "the recording does not say where the head looked";
      return h;
    }
    h.joints = {now, *q, 0.0, 0.0};
    if (before) {
      h.joints.pan_radps = (q->pan_rad - before->pan_rad) / seconds(period);
      h.joints.tilt_radps = (q->tilt_rad - before->tilt_rad) / seconds(period);
    }
    return h;
  }

  const SkipRecording& recording_;
  const FrameLoader& load_;
  SkipSeer& seer_;
  Duration begin_{};
  Duration end_{};
  std::size_t near_ = 0;
  std::size_t far_ = 0;
  bool told_ = false;
  int unread_ = 0;
};

}  // namespace

TrackedThrow track_recording(const SkipRecording& recording, servo::SkipConfig config, const servo::IceEstimate& ice,
                             SkipSeer& seer, const FrameLoader& load) {
  Player player(recording, load, seer);
  servo::Skip skip(for_recordings(std::move(config), recording), servo::from_other_end(ice), player.begin());
  TrackedThrow tracked;
  tracked.origin = player.begin();
  if (recording.release) tracked.origin = player.replayed(recording.release->signal.stamp.time_since_epoch());
  for (Stamp now = player.begin(); now <= player.end() && !skip.finished(); now += period) {
    skip.step(player.observe(now, skip.diagnosis()), period);
    const servo::SkipDiagnosis& known = skip.diagnosis();
    if (known.stop && known.thrown->y_m > servo::hog_line_m) tracked.foretold = known.stop;
  }
  skip.conclude(player.end());
  tracked.report = skip.report();
  tracked.known = skip.diagnosis();
  tracked.near_frames = player.near_frames();
  tracked.far_frames = player.far_frames();
  tracked.unread = player.unread();
  return tracked;
}

}  // namespace hogline
