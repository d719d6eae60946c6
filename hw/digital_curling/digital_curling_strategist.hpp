// Adapter: a Digital Curling 3 program as a team's strategist. We are the server; the program connects to our port.
#pragma once

#include "hw/digital_curling/client_port.hpp"
#include "hw/digital_curling/session.hpp"
#include "hw/strategist.hpp"

namespace hogline::hw {

struct DigitalCurlingConfig {
  std::string address = "127.0.0.1";
  int port = 0;  ///< 0: any that is free
  digital_curling::SessionConfig session;
};

class DigitalCurlingStrategist final : public Strategist {
 public:
  /// Listens at once; throws as ClientPort does.
  explicit DigitalCurlingStrategist(const DigitalCurlingConfig& config);

  void begin(const std::array<std::string, servo::team_count>& names, Stamp now) override;
  void tell(const servo::GameUpdate& update, Stamp now) override;
  void step(Stamp now) override;
  const StrategistState& state() const override { return session_.state(); }

  int port() const { return port_.port(); }
  const std::array<int, 4>& player_order() const { return session_.player_order(); }

 private:
  void send();

  digital_curling::ClientPort port_;
  digital_curling::Session session_;
};

}  // namespace hogline::hw
