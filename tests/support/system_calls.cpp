#include "tests/support/system_calls.h"

#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

// Defined where a program is linked with a sanitiser, however its parts were compiled.
extern "C" {
[[gnu::weak]] void __asan_init();  // NOLINT(bugprone-reserved-identifier)
[[gnu::weak]] void __tsan_init();  // NOLINT(bugprone-reserved-identifier)
}

namespace saca {
namespace {

constexpr int was_called = 1;
constexpr int no_filter = 2;

void say(std::string_view text) {
  (void)!::write(STDERR_FILENO, text.data(), text.size());
}

void tell_and_end(int, siginfo_t* what, void*) {
  std::array<char, 16> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), what->si_syscall);
  say("system call ");
  say({digits.data(), static_cast<std::size_t>(end.ptr - digits.data())});
  say("\n");
  ::_exit(was_called);
}

[[nodiscard]] bool forbid_all_but(const std::vector<std::uint32_t>& allowed) {
  struct sigaction action {};
  action.sa_sigaction = tell_and_end;
  action.sa_flags = SA_SIGINFO;
  (void)::sigaction(SIGSYS, &action, nullptr);
  std::vector<sock_filter> filter{BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr))};
  for (const std::uint32_t call : allowed) {
    filter.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, call, 0, 1));
    filter.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW));
  }
  filter.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_TRAP));
  const sock_fprog program{static_cast<unsigned short>(filter.size()), filter.data()};
  return ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
         ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
}

const std::vector<std::uint32_t> harmless{SYS_write, SYS_rt_sigreturn, SYS_exit_group};

/// The exit code of a process in which nothing but the time is asked for.
int asking_the_time() {
  const pid_t child = ::fork();
  if (child == 0) {
    if (!forbid_all_but({SYS_rt_sigreturn, SYS_exit_group})) {
      ::_exit(no_filter);
    }
    (void)std::chrono::steady_clock::now();
    ::_exit(0);
  }
  int status = 0;
  (void)::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : was_called;  // it may not even say so
}

}  // namespace

std::string why_system_calls_cannot_be_forbidden() {
  if (&__asan_init != nullptr || &__tsan_init != nullptr) {
    return "a sanitiser makes system calls of its own";
  }
  return asking_the_time() == no_filter ? "this system lets no process filter its system calls"
                                        : "";
}

void forbid_system_calls() {
  std::vector<std::uint32_t> allowed = harmless;
  if (asking_the_time() == was_called) {
    say("asking the time is a system call on this machine: it is let pass\n");
    allowed.push_back(SYS_clock_gettime);
  }
  if (!forbid_all_but(allowed)) {
    ::_exit(no_filter);
  }
}

}  // namespace saca
