#include "saca/thinking/language_model/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>

namespace saca::language_model {
namespace {

using namespace std::chrono_literals;

// The clock may be another than the system's, so a wait looks at it at least this often.
constexpr auto longest_wait = 10ms;
constexpr std::size_t longest_line = 1U << 20U;  // bytes: hundred times the longest real one
constexpr auto longest_farewell = 2s;            // for a killed process to be gone

Error gone() {
  return {Error::Code::unreadable, "model process: want it running, it is gone"};
}

// Both ends, or nothing. A socket, not pipes: a write to a program that is gone then gives an error
// instead of a signal.
std::optional<std::array<int, 2>> connection() {
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    return std::nullopt;
  }
  return ends;
}

// Whether a variable's name is one under which people keep what nobody else may know.
bool is_secret(std::string_view variable) {
  std::string name(variable.substr(0, variable.find('=')));
  std::transform(name.begin(), name.end(), name.begin(), [](char c) {
    return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  });
  constexpr std::array<std::string_view, 5> words{"KEY", "TOKEN", "SECRET", "PASSW", "CREDENTIAL"};
  return std::any_of(words.begin(), words.end(),
                     [&](std::string_view word) { return name.find(word) != std::string::npos; });
}

// As POSIX wants it: pointers to the environment's own texts, and nullptr.
std::vector<char*> environment_without_secrets() {
  std::vector<char*> kept;
  for (char** variable = environ; *variable != nullptr; ++variable) {
    if (!is_secret(*variable)) {
      kept.push_back(*variable);
    }
  }
  kept.push_back(nullptr);
  return kept;
}

// No dump of what it was told, no file without end, no more files than a model needs; and where
// memory is short, it is the first to be ended. How much it may take is left to the system: drivers
// of accelerators reserve more than there is.
void restrain(pid_t pid) {
  constexpr rlim_t longest_file = rlim_t{1} << 30U;  // bytes; drivers keep compiled programs
  for (const auto& [resource, most] :
       {std::pair{RLIMIT_CORE, rlim_t{0}}, std::pair{RLIMIT_NOFILE, rlim_t{1024}},
        std::pair{RLIMIT_FSIZE, longest_file}}) {
    rlimit limit{};
    if (prlimit(pid, resource, nullptr, &limit) == 0) {
      limit.rlim_max = std::min(limit.rlim_max, most);
      limit.rlim_cur = std::min(limit.rlim_cur, limit.rlim_max);
      prlimit(pid, resource, &limit, nullptr);
    }
  }
  const std::string badness = "/proc/" + std::to_string(pid) + "/oom_score_adj";
  const int file = open(badness.c_str(), O_WRONLY | O_CLOEXEC);
  if (file >= 0) {
    (void)!write(file, "1000", 4);
    close(file);
  }
}

// @return  0, or the error number
int spawn(const std::vector<std::string>& command, int socket, pid_t& pid) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, socket, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, socket, STDOUT_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  // Its own group: Ctrl-C at the terminal is ours to handle, and kill reaches its children too.
  posix_spawnattr_setpgroup(&attributes, 0);
  sigset_t signals;
  sigemptyset(&signals);
  posix_spawnattr_setsigmask(&attributes, &signals);
  sigfillset(&signals);
  posix_spawnattr_setsigdefault(&attributes, &signals);
  posix_spawnattr_setflags(&attributes,
                           POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  std::vector<char*> arguments;
  arguments.reserve(command.size() + 1);
  for (const std::string& argument : command) {
    arguments.push_back(const_cast<char*>(argument.c_str()));  // NOLINT: as POSIX wants it
  }
  arguments.push_back(nullptr);
  const std::vector<char*> environment = environment_without_secrets();
  const int error = posix_spawn(&pid, command.front().c_str(), &actions, &attributes,
                                arguments.data(), environment.data());
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  return error;
}

}  // namespace

ChildProcess::ChildProcess(std::vector<std::string> command, Clock& clock)
    : command_(std::move(command)), clock_(clock) {
  expects(!command_.empty(), "a command");
}

ChildProcess::~ChildProcess() {
  kill();
  drop_connection();
  // Real time: a killed process ends on the system's clock, whatever ours is.
  const auto end = std::chrono::steady_clock::now() + longest_farewell;
  reap();
  while (!ending_.empty() && std::chrono::steady_clock::now() < end) {
    poll(nullptr, 0, 1);
    reap();
  }
}

std::optional<Error> ChildProcess::start() {
  reap();
  if (running()) {
    return std::nullopt;
  }
  drop_connection();
  const auto ends = connection();
  if (!ends) {
    return Error{Error::Code::unreadable,
                 std::string("model process: no connection: ") + std::strerror(errno)};
  }
  const auto [ours, theirs] = *ends;
  pid_t pid = -1;
  const int error = spawn(command_, theirs, pid);
  close(theirs);
  if (error != 0) {
    close(ours);
    return Error{Error::Code::unreadable,
                 command_.front() + ": cannot be started: " + std::strerror(error)};
  }
  restrain(pid);
  fcntl(ours, F_SETFL, O_NONBLOCK);
  socket_ = ours;
  const std::lock_guard lock(mutex_);
  pid_ = pid;
  return std::nullopt;
}

bool ChildProcess::wait_for(short events, Clock::Time deadline, const std::stop_token& stop) const {
  while (true) {
    const auto left = deadline - clock_.now();
    if (left <= 0ns || stop.stop_requested()) {
      return false;
    }
    const auto wait = std::min<Clock::Time>(left, longest_wait);
    const timespec time{.tv_sec = 0, .tv_nsec = wait.count()};
    pollfd fd{.fd = socket_, .events = events, .revents = 0};
    if (ppoll(&fd, 1, &time, nullptr) > 0) {
      return true;
    }
  }
}

std::optional<Error> ChildProcess::send(std::string_view line, Clock::Time deadline) {
  if (socket_ < 0) {
    return gone();
  }
  std::string bytes(line);
  bytes += '\n';
  for (std::size_t sent = 0; sent < bytes.size();) {
    const ssize_t n =
        ::send(socket_, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (n > 0) {
      sent += static_cast<std::size_t>(n);
    } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
      if (!wait_for(POLLOUT, deadline)) {
        return Error{Error::Code::too_late, "model process: does not read"};
      }
    } else if (errno != EINTR) {
      kill();
      return gone();
    }
  }
  return std::nullopt;
}

Result<std::string> ChildProcess::receive(Clock::Time deadline, const std::stop_token& stop) {
  std::size_t searched = 0;
  while (true) {
    const std::size_t end = unread_.find('\n', searched);
    if (end != std::string::npos) {
      std::string line = unread_.substr(0, end);
      unread_.erase(0, end + 1);
      return line;
    }
    if (unread_.size() > longest_line) {
      return Error{Error::Code::malformed, "model process: want lines of at most 1 MiB"};
    }
    searched = unread_.size();
    if (socket_ < 0) {
      return gone();
    }
    // Looked at before each read, too: a program that never stops talking is late as well.
    if (!wait_for(POLLIN, deadline, stop)) {
      return Error{Error::Code::too_late, "model process: nothing in time"};
    }
    std::array<char, 4096> buffer{};
    const ssize_t n = recv(socket_, buffer.data(), buffer.size(), MSG_DONTWAIT);
    if (n > 0) {
      unread_.append(buffer.data(), static_cast<std::size_t>(n));
    } else if (n == 0 || (errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR)) {
      kill();
      drop_connection();
      return gone();
    }
  }
}

void ChildProcess::kill() noexcept {
  const std::lock_guard lock(mutex_);
  if (pid_ < 0) {
    return;
  }
  // It is not yet reaped, so the number is still its own. The group first: it may not exist yet or
  // any more, while the process does.
  ::kill(-pid_, SIGKILL);
  ::kill(pid_, SIGKILL);
  ending_.push_back(pid_);
  pid_ = -1;
}

void ChildProcess::drop_connection() noexcept {
  if (socket_ >= 0) {
    close(socket_);
    socket_ = -1;
  }
  unread_.clear();
}

void ChildProcess::reap() noexcept {
  const std::lock_guard lock(mutex_);
  if (pid_ >= 0 && waitpid(pid_, nullptr, WNOHANG) != 0) {
    ::kill(-pid_, SIGKILL);  // what it began may live on
    pid_ = -1;
  }
  ending_.erase(std::remove_if(ending_.begin(), ending_.end(),
                               [](pid_t pid) { return waitpid(pid, nullptr, WNOHANG) != 0; }),
                ending_.end());
}

bool ChildProcess::running() const {
  return pid().has_value();
}

std::optional<pid_t> ChildProcess::pid() const {
  const std::lock_guard lock(mutex_);
  return pid_ >= 0 ? std::optional(pid_) : std::nullopt;
}

}  // namespace saca::language_model
