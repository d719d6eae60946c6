// A listening TCP port for one client: system calls and nothing else. Nothing blocks.
#pragma once

#include <optional>
#include <string>

namespace hogline::hw::digital_curling {

class ClientPort {
 public:
  /// Listens at once. `address` is an IPv4 address of this machine; port 0 takes any that is free. Throws
  /// std::system_error when that can not be, std::invalid_argument for what is no address.
  ClientPort(const std::string& address, int port);
  ~ClientPort();
  ClientPort(const ClientPort&) = delete;
  ClientPort& operator=(const ClientPort&) = delete;

  int port() const { return port_; }
  /// "127.0.0.1:10000"
  std::string where() const;

  /// Takes the first client that calls; every later one, as long as this stands, is hung up on.
  struct Calls {
    bool connected = false;                  ///< just now
    std::optional<std::string> turned_away;  ///< "127.0.0.1:53211", the last of them
  };
  Calls accept();

  struct Heard {
    std::string bytes;
    std::optional<std::string> gone;  ///< the client is: why
  };
  /// What has come, at most some ten thousand bytes at a time.
  Heard hear();
  /// Sends as much as goes now, and takes it off. The reason when the client is gone.
  std::optional<std::string> send(std::string& bytes);
  /// Ends the connection; calls are turned away still.
  void hang_up();

 private:
  std::string address_;
  int port_ = 0;
  int listening_ = -1;
  int client_ = -1;
  bool had_client_ = false;
};

}  // namespace hogline::hw::digital_curling
