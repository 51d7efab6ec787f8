#pragma once

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <deque>
#include <optional>
#include <string>
#include <utility>

namespace saca::model_host {

/// Lines from a file descriptor: waited for one by one, and looked through without waiting.
class Inbox {
 public:
  explicit Inbox(int fd) : fd_(fd) {}

  /// The next line, without its end; waits for it. nullopt: the input has ended.
  [[nodiscard]] std::optional<std::string> take() {
    while (lines_.empty() && !ended_) {
      read_on();
    }
    if (lines_.empty()) {
      return std::nullopt;
    }
    std::string line = std::move(lines_.front());
    lines_.pop_front();
    return line;
  }

  /// Whether a line that has come and is not taken is such a one.
  template <class Predicate>
  [[nodiscard]] bool holds(Predicate is_such) {
    pollfd look{.fd = fd_, .events = POLLIN, .revents = 0};
    while (!ended_ && poll(&look, 1, 0) > 0) {
      read_on();
    }
    return std::any_of(lines_.begin(), lines_.end(), is_such);
  }

 private:
  void read_on() {
    std::array<char, 4096> buffer{};
    const ssize_t n = read(fd_, buffer.data(), buffer.size());
    if (n < 0 && (errno == EINTR || errno == EAGAIN)) {
      return;
    }
    if (n <= 0) {
      ended_ = true;
      if (!unread_.empty()) {
        lines_.push_back(std::exchange(unread_, {}));
      }
      return;
    }
    unread_.append(buffer.data(), static_cast<std::size_t>(n));
    std::size_t begin = 0;
    for (std::size_t end = 0; (end = unread_.find('\n', begin)) != std::string::npos;
         begin = end + 1) {
      lines_.push_back(unread_.substr(begin, end - begin));
    }
    unread_.erase(0, begin);
  }

  int fd_;
  bool ended_ = false;
  std::string unread_;  ///< of a line whose end has not come
  std::deque<std::string> lines_;
};

}  // namespace saca::model_host
