#pragma once

#include <string>
#include <utility>
#include <variant>

#include "saca/base/core/contract.h"

namespace saca {

/// Why something outside the program could not be used. Callers branch on the code, people read the
/// message.
struct Error {
  enum class Code { unreadable, unwritable, malformed, out_of_range, too_late };

  Code code = Code::unreadable;
  std::string message;

  bool operator==(const Error&) const = default;
};

/// A value, or the reason there is none. Member names match std::expected, which replaces this
/// class once the project moves to C++23.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::move(value)) {}      // NOLINT: implicit, so `return value;` works
  Result(Error error) : state_(std::move(error)) {}  // NOLINT: implicit, so `return Error{};` works

  [[nodiscard]] bool has_value() const noexcept { return std::holds_alternative<T>(state_); }

  /// @throws ContractViolation  if there is no value: check has_value() first
  [[nodiscard]] const T& value() const& {
    expects(has_value(), "has_value()");
    return std::get<T>(state_);
  }
  /// Likewise, moved out of a result that is not needed any more.
  [[nodiscard]] T value() && {
    expects(has_value(), "has_value()");
    return std::get<T>(std::move(state_));
  }

  /// @throws ContractViolation  if there is a value
  [[nodiscard]] const Error& error() const {
    expects(!has_value(), "!has_value()");
    return std::get<Error>(state_);
  }

 private:
  std::variant<T, Error> state_;
};

}  // namespace saca
