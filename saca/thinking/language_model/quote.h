#pragma once

#include <string>
#include <string_view>
#include <utility>

namespace saca::language_model {

/// The beginning of a foreign text as an error's message may hold it: one line of whole characters,
/// at most 200 of them and "..." where there are more, spaces where control characters or ends of
/// lines were.
///
/// @param secret  never shown: eight or more of its characters in a row become "***", wherever the
///                text was cut; all of it where it has fewer. May be empty.
[[nodiscard]] std::string quote(std::string_view text, std::string_view secret);

/// A foreign text that comes piece by piece, without a secret in it: eight or more of its
/// characters in a row become "***", wherever the pieces are cut; all of it where it has fewer.
class SecretFilter {
 public:
  /// @param secret  may be empty
  explicit SecretFilter(std::string secret = {}) : secret_(std::move(secret)) {}

  /// @return  what can be shown by now; an end that may go on to be the secret waits
  [[nodiscard]] std::string take(std::string_view piece);
  /// What waits, when no piece follows.
  [[nodiscard]] std::string rest();

 private:
  std::string secret_;
  std::string waiting_;
};

}  // namespace saca::language_model
