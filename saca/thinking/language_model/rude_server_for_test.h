#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <functional>
#include <list>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace saca::language_model {

// One connection with a request, as a server's behaviour sees it.
class Visit {
 public:
  explicit Visit(int socket) : socket_(socket) {
    const int on = 1;  // small packets are not kept back
    setsockopt(socket_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  }

  // The request as it came: headers and body.
  [[nodiscard]] const std::string& request() const { return request_; }

  // Waits for the whole request.
  // @return  false when the other side left before
  bool read_request() {
    while (true) {
      const std::size_t end = request_.find("\r\n\r\n");
      if (end != std::string::npos && request_.size() >= end + 4 + body_size()) {
        return true;
      }
      std::array<char, 4096> buffer{};
      const ssize_t n = recv(socket_, buffer.data(), buffer.size(), 0);
      if (n <= 0) {
        return false;
      }
      request_.append(buffer.data(), static_cast<std::size_t>(n));
    }
  }
  // @return  false when the other side is gone
  bool send(std::string_view bytes) const {
    while (!bytes.empty()) {
      const ssize_t n = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (n <= 0) {
        return false;
      }
      bytes.remove_prefix(static_cast<std::size_t>(n));
    }
    return true;
  }
  // In pieces of `size` bytes, each a packet of its own where the system can.
  void send_in_pieces(std::string_view bytes, std::size_t size) const {
    for (; !bytes.empty() && send(bytes.substr(0, size)); wait(0)) {
      bytes.remove_prefix(std::min(size, bytes.size()));
    }
  }
  // Until the other side leaves, or for this long.
  // @return  whether it left
  bool wait(int milliseconds) const {
    pollfd fd{.fd = socket_, .events = POLLRDHUP, .revents = 0};
    return poll(&fd, 1, milliseconds) > 0;
  }
  // The connection ends as if the machine had been switched off and on.
  void reset() const {
    const linger now{.l_onoff = 1, .l_linger = 0};
    setsockopt(socket_, SOL_SOCKET, SO_LINGER, &now, sizeof now);
  }

 private:
  [[nodiscard]] std::size_t body_size() const {
    constexpr std::string_view key = "Content-Length: ";
    const std::size_t at = request_.find(key);
    return at == std::string::npos ? 0 : std::stoul(request_.substr(at + key.size()));
  }

  int socket_;
  std::string request_;
};

// A server on 127.0.0.1 that answers requests as a test says, each by a thread of its own.
class RudeServer {
 public:
  using Behaviour = std::function<void(Visit&)>;

  // The n-th request meets the n-th behaviour, those after the last meet the last.
  explicit RudeServer(std::vector<Behaviour> behaviours) : behaviours_(std::move(behaviours)) {
    listener_ = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{.sin_family = AF_INET, .sin_port = 0, .sin_addr = {htonl(INADDR_LOOPBACK)}};
    socklen_t size = sizeof address;
    auto* any = reinterpret_cast<sockaddr*>(&address);  // NOLINT: as POSIX wants it
    if (bind(listener_, any, size) == 0 && listen(listener_, 16) == 0 &&
        getsockname(listener_, any, &size) == 0) {
      port_ = ntohs(address.sin_port);
    }
    acceptor_ = std::thread([this] { accept_all(); });
  }
  RudeServer(const RudeServer&) = delete;
  RudeServer& operator=(const RudeServer&) = delete;
  ~RudeServer() {
    shutdown(listener_, SHUT_RDWR);  // ends accept
    acceptor_.join();
    close(listener_);
    {
      const std::lock_guard lock(mutex_);
      for (const int socket : sockets_) {
        shutdown(socket, SHUT_RDWR);  // ends whatever a behaviour waits for
      }
    }
    for (std::thread& visit : visits_) {
      visit.join();
    }
    for (const int socket : sockets_) {
      close(socket);
    }
  }

  [[nodiscard]] std::string url() const {
    return "http://127.0.0.1:" + std::to_string(port_) + "/v1";
  }
  [[nodiscard]] std::size_t num_requests() const {
    const std::lock_guard lock(mutex_);
    return requests_.size();
  }
  [[nodiscard]] std::vector<std::string> requests() const {
    const std::lock_guard lock(mutex_);
    return requests_;
  }

 private:
  void accept_all() {
    for (int socket = 0; (socket = accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC)) >= 0;) {
      const std::lock_guard lock(mutex_);
      sockets_.push_back(socket);
      visits_.emplace_back([this, socket] { serve(socket); });
    }
  }
  void serve(int socket) {
    Visit visit(socket);
    if (visit.read_request()) {
      std::size_t number = 0;
      {
        const std::lock_guard lock(mutex_);
        number = requests_.size();
        requests_.push_back(visit.request());
      }
      behaviours_[std::min(number, behaviours_.size() - 1)](visit);
    }
    const std::lock_guard lock(mutex_);
    sockets_.remove(socket);
    close(socket);
  }

  std::vector<Behaviour> behaviours_;
  int listener_ = -1;
  int port_ = 0;
  std::thread acceptor_;
  mutable std::mutex mutex_;
  std::list<int> sockets_;             // of visits under way; guarded by mutex_
  std::vector<std::thread> visits_;    // guarded by mutex_ until the acceptor has ended
  std::vector<std::string> requests_;  // guarded by mutex_
};

// What servers send.

inline std::string http(int status, std::string_view body, std::string_view headers = {}) {
  return "HTTP/1.1 " + std::to_string(status) + " x\r\nConnection: close\r\n" +
         std::string(headers) + "Content-Length: " + std::to_string(body.size()) + "\r\n\r\n" +
         std::string(body);
}
// The beginning of a stream that ends with the connection.
inline const std::string stream_head =
    "HTTP/1.1 200 OK\r\nContent-Type: text/event-stream\r\nConnection: close\r\n\r\n";
// @param text  as it stands in JSON
inline std::string said(std::string_view text) {
  return R"(data: {"choices":[{"index":0,"delta":{"content":")" + std::string(text) +
         "\"},\"finish_reason\":null}]}\n\n";
}
inline const std::string stream_end =
    "data: {\"choices\":[{\"index\":0,\"delta\":{},\"finish_reason\":\"stop\"}]}\n\n"
    "data: {\"choices\":[],\"usage\":{\"prompt_tokens\":330,\"completion_tokens\":7}}\n\n"
    "data: [DONE]\n\n";
inline std::string good_reply(int policy) {
  return stream_head + ": hello\n\n" + said("it is \xE2\x82\xAC, ") +
         said("so\\nResponse to user: " + std::to_string(policy)) + stream_end;
}

// A behaviour that sends these bytes and ends the connection.
inline RudeServer::Behaviour sends(std::string bytes) {
  return [bytes = std::move(bytes)](Visit& visit) { (void)visit.send(bytes); };
}
// One that sends these and then nothing more.
inline RudeServer::Behaviour falls_silent_after(std::string bytes) {
  return [bytes = std::move(bytes)](Visit& visit) {
    (void)visit.send(bytes);
    visit.wait(-1);
  };
}

}  // namespace saca::language_model
