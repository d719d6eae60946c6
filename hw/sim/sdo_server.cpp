#include "hw/sim/sdo_server.hpp"

#include <algorithm>
#include <span>

namespace hogline::hw::sim {
namespace {

constexpr std::uint32_t toggle_not_alternated = 0x05030000;
constexpr std::uint32_t command_unknown = 0x05040001;
constexpr std::uint32_t length_mismatch = 0x06070010;

std::uint32_t four_bytes(const std::array<std::uint8_t, 8>& data) {
  return data[4] | (std::uint32_t{data[5]} << 8) | (std::uint32_t{data[6]} << 16) | (std::uint32_t{data[7]} << 24);
}

}  // namespace

CanFrame SdoServer::answer(std::uint8_t command, std::uint32_t value) const {
  CanFrame frame{.id = 0x580u + node_, .length = 8, .data = {}};
  frame.data[0] = command;
  frame.data[1] = static_cast<std::uint8_t>(index_ & 0xFF);
  frame.data[2] = static_cast<std::uint8_t>(index_ >> 8);
  frame.data[3] = sub_;
  for (std::size_t i = 0; i < 4; ++i) frame.data[4 + i] = static_cast<std::uint8_t>((value >> (8 * i)) & 0xFF);
  return frame;
}

CanFrame SdoServer::abort(std::uint32_t code) {
  transfer_ = Transfer::none;
  return answer(0x80, code);
}

std::optional<CanFrame> SdoServer::on_request(const CanFrame& request) {
  if (request.length != 8) return std::nullopt;
  const int specifier = request.data[0] >> 5;
  if (specifier == 1 || specifier == 2) {  // a new transfer ends an unfinished one
    transfer_ = Transfer::none;
    index_ = static_cast<std::uint16_t>(request.data[1] | (request.data[2] << 8));
    sub_ = request.data[3];
  }
  switch (specifier) {
    case 0:
      return download_segment(request.data);
    case 1:
      return initiate_download(request.data);
    case 2:
      return initiate_upload();
    case 3:
      return upload_segment(request.data);
    case 4:
      reset();
      return std::nullopt;
    default:
      return abort(command_unknown);
  }
}

CanFrame SdoServer::initiate_download(const Data& request) {
  const bool expedited = (request[0] & 0x02) != 0;
  const bool size_given = (request[0] & 0x01) != 0;
  if (!expedited) {
    transfer_ = Transfer::download;
    toggle_ = false;
    data_.clear();
    announced_.reset();
    if (size_given) announced_ = four_bytes(request);
    return answer(0x60);
  }
  std::size_t size = 4;
  if (size_given) {
    size -= (request[0] >> 2) & 0x03u;
  } else if (const ObjectEntry* entry = objects_.find(index_, sub_)) {
    size = std::min<std::size_t>(4, entry->bytes.size());
  }
  const std::uint32_t code = objects_.write(index_, sub_, std::span{request}.subspan(4, size));
  return code == 0 ? answer(0x60) : abort(code);
}

CanFrame SdoServer::download_segment(const Data& request) {
  if (transfer_ != Transfer::download) return abort(command_unknown);
  const bool toggle = (request[0] & 0x10) != 0;
  if (toggle != toggle_) return abort(toggle_not_alternated);
  const std::size_t size = 7u - ((request[0] >> 1) & 0x07u);
  data_.insert(data_.end(), request.begin() + 1, request.begin() + 1 + static_cast<std::ptrdiff_t>(size));

  const bool last = (request[0] & 0x01) != 0;
  if (last) {
    transfer_ = Transfer::none;
    if (announced_ && *announced_ != data_.size()) return abort(length_mismatch);
    const std::uint32_t code = objects_.write(index_, sub_, data_);
    if (code != 0) return abort(code);
  }
  CanFrame frame{.id = 0x580u + node_, .length = 8, .data = {}};
  frame.data[0] = static_cast<std::uint8_t>(0x20 | (toggle ? 0x10 : 0x00));
  toggle_ = !toggle_;
  return frame;
}

CanFrame SdoServer::initiate_upload() {
  data_.clear();
  const std::uint32_t code = objects_.read(index_, sub_, data_);
  if (code != 0) return abort(code);
  if (!data_.empty() && data_.size() <= 4) {
    std::uint32_t value = 0;
    for (std::size_t i = data_.size(); i-- > 0;) value = (value << 8) | data_[i];
    return answer(static_cast<std::uint8_t>(0x43 | ((4 - data_.size()) << 2)), value);
  }
  transfer_ = Transfer::upload;
  toggle_ = false;
  sent_ = 0;
  return answer(0x41, static_cast<std::uint32_t>(data_.size()));
}

CanFrame SdoServer::upload_segment(const Data& request) {
  if (transfer_ != Transfer::upload) return abort(command_unknown);
  const bool toggle = (request[0] & 0x10) != 0;
  if (toggle != toggle_) return abort(toggle_not_alternated);

  const std::size_t size = std::min<std::size_t>(7, data_.size() - sent_);
  const bool last = sent_ + size == data_.size();
  CanFrame frame{.id = 0x580u + node_, .length = 8, .data = {}};
  frame.data[0] = static_cast<std::uint8_t>((toggle ? 0x10u : 0x00u) | ((7u - size) << 1) | (last ? 1u : 0u));
  std::copy_n(data_.begin() + static_cast<std::ptrdiff_t>(sent_), size, frame.data.begin() + 1);
  sent_ += size;
  toggle_ = !toggle_;
  if (last) transfer_ = Transfer::none;
  return frame;
}

}  // namespace hogline::hw::sim
