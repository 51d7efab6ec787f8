#pragma once

#include <string>

namespace saca {

/// Why it cannot be shown here that code makes no system call: a sanitiser makes its own, or the
/// system lets nobody filter them. Empty: it can.
[[nodiscard]] std::string why_system_calls_cannot_be_forbidden();

/// From here on this thread may only write, return from a signal and end the process. For a process
/// that is there for it (EXPECT_EXIT): on any other system call it says `system call NUMBER` on the
/// error stream, and ends with exit code 1. The filter is the kernel's (seccomp) and cannot be
/// taken off.
///
/// Where asking the time is a system call on this machine, that one is let pass, and this says so
/// on the error stream.
void forbid_system_calls();

}  // namespace saca
