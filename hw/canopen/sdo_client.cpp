#include "hw/canopen/sdo_client.hpp"

#include <cassert>
#include <cstdio>
#include <utility>

namespace hogline::hw {
namespace {

// Far above any object hogline reads; a server that announces or sends more is broken.
constexpr std::uint32_t max_upload_bytes = 1024;

}  // namespace

std::optional<std::uint32_t> SdoResult::value() const {
  if (outcome != Outcome::ok || data.empty() || data.size() > 4) return std::nullopt;
  std::uint32_t value = 0;
  for (std::size_t i = data.size(); i-- > 0;) value = (value << 8) | data[i];
  return value;
}

std::string SdoResult::describe() const {
  char text[128];
  const std::string where = to_string(address);
  switch (outcome) {
    case Outcome::ok:
      return "SDO " + where + ": done";
    case Outcome::timeout:
      return "SDO " + where + ": no answer";
    case Outcome::aborted:
      std::snprintf(text, sizeof text, "SDO %s: aborted %08X, %s", where.c_str(), unsigned{abort_code},
                    sdo_abort_meaning(abort_code));
      return text;
    case Outcome::protocol:
      std::snprintf(text, sizeof text, "SDO %s: answer breaks the protocol (%s)", where.c_str(),
                    sdo_abort_meaning(abort_code));
      return text;
  }
  return "SDO " + where;
}

void SdoClient::begin(Phase phase, ObjectAddress address, const CanFrame& frame, Stamp now) {
  assert(!busy());
  phase_ = phase;
  address_ = address;
  deadline_ = now + timeout_;
  toggle_ = false;
  announced_size_.reset();
  data_.clear();
  result_.reset();
  outgoing_ = frame;
}

void SdoClient::start_download(const SdoWrite& write, Stamp now) {
  begin(Phase::downloading, write.address, sdo_download_frame(node_, write), now);
}

void SdoClient::start_upload(ObjectAddress address, Stamp now) {
  begin(Phase::upload_started, address, sdo_upload_frame(node_, address), now);
}

void SdoClient::cancel() {
  phase_ = Phase::idle;
  outgoing_.reset();
  result_.reset();
}

void SdoClient::finish(SdoResult::Outcome outcome, std::uint32_t abort_code) {
  result_ = SdoResult{outcome, address_, abort_code, std::exchange(data_, {})};
  phase_ = Phase::idle;
}

void SdoClient::refuse(std::uint32_t abort_code) {
  outgoing_ = sdo_abort_frame(node_, address_, abort_code);
  finish(SdoResult::Outcome::protocol, abort_code);
}

void SdoClient::on_frame(const CanFrame& frame, Stamp now) {
  if (!busy()) return;
  const SdoResponse response = decode_sdo_response(frame);

  if (const auto* aborted = std::get_if<SdoAborted>(&response)) {
    if (aborted->address != address_) return refuse(sdo_abort_command);
    return finish(SdoResult::Outcome::aborted, aborted->code);
  }
  if (const auto* confirmed = std::get_if<SdoDownloadConfirmed>(&response)) {
    if (phase_ != Phase::downloading || confirmed->address != address_) return refuse(sdo_abort_command);
    return finish(SdoResult::Outcome::ok);
  }
  if (const auto* value = std::get_if<SdoExpedited>(&response)) return on_expedited(*value);
  if (const auto* start = std::get_if<SdoSegmentedStart>(&response)) return on_segmented_start(*start, now);
  if (const auto* segment = std::get_if<SdoSegment>(&response)) return on_segment(*segment, now);
  refuse(sdo_abort_command);
}

void SdoClient::on_expedited(const SdoExpedited& value) {
  if (phase_ != Phase::upload_started || value.address != address_) return refuse(sdo_abort_command);
  data_.assign(value.data.begin(), value.data.begin() + value.size);
  finish(SdoResult::Outcome::ok);
}

void SdoClient::on_segmented_start(const SdoSegmentedStart& start, Stamp now) {
  if (phase_ != Phase::upload_started || start.address != address_) return refuse(sdo_abort_command);
  if (start.size && *start.size > max_upload_bytes) return refuse(sdo_abort_length);
  announced_size_ = start.size;
  phase_ = Phase::upload_segments;
  request_segment(now);
}

void SdoClient::on_segment(const SdoSegment& segment, Stamp now) {
  if (phase_ != Phase::upload_segments) return refuse(sdo_abort_command);
  if (segment.toggle != toggle_) return refuse(sdo_abort_toggle);
  data_.insert(data_.end(), segment.data.begin(), segment.data.begin() + segment.size);

  if (data_.size() > announced_size_.value_or(max_upload_bytes)) return refuse(sdo_abort_length);
  if (!segment.last) {
    toggle_ = !toggle_;
    return request_segment(now);
  }
  if (announced_size_ && data_.size() != *announced_size_) return refuse(sdo_abort_length);
  finish(SdoResult::Outcome::ok);
}

void SdoClient::request_segment(Stamp now) {
  outgoing_ = sdo_upload_segment_frame(node_, toggle_);
  deadline_ = now + timeout_;
}

void SdoClient::step(Stamp now) {
  if (!busy() || now < deadline_) return;
  outgoing_ = sdo_abort_frame(node_, address_, sdo_abort_timeout);
  finish(SdoResult::Outcome::timeout, sdo_abort_timeout);
}

std::optional<CanFrame> SdoClient::take_frame() { return std::exchange(outgoing_, std::nullopt); }
std::optional<SdoResult> SdoClient::take_result() { return std::exchange(result_, std::nullopt); }

}  // namespace hogline::hw
