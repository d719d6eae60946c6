#include "hw/digital_curling/digital_curling_strategist.hpp"

namespace hogline::hw {

DigitalCurlingStrategist::DigitalCurlingStrategist(const DigitalCurlingConfig& config)
    : port_(config.address, config.port), session_(config.session, port_.where()) {}

void DigitalCurlingStrategist::send() {
  if (const auto gone = port_.send(session_.outgoing())) session_.lost("vanished: " + *gone);
}

void DigitalCurlingStrategist::begin(const std::array<std::string, servo::team_count>& names, Stamp now) {
  session_.begin(names, now);
  send();
}

void DigitalCurlingStrategist::tell(const servo::GameUpdate& update, Stamp now) {
  session_.tell(update, now);
  send();
}

void DigitalCurlingStrategist::step(Stamp now) {
  const auto calls = port_.accept();
  if (calls.connected) session_.connected(now);
  if (calls.turned_away) session_.note("a second client (" + *calls.turned_away + ") was turned away");
  // All that has come belongs to this moment: what a client sent in one go is seen in one go. Some hundred thousand
  // bytes are more than any client may send in a step; one that floods the line is not read on for ever.
  for (int i = 0; i < 16; ++i) {
    const auto heard = port_.hear();
    if (heard.gone) session_.lost("vanished: " + *heard.gone);
    if (heard.bytes.empty()) break;
    session_.receive(heard.bytes, now);
  }
  session_.tick(now);
  send();
  if (state().phase == StrategistPhase::failed) port_.hang_up();
}

}  // namespace hogline::hw
