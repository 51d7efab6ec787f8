#pragma once

#include <string>
#include <string_view>

namespace saca::language_model {

/// What stands in a prompt behind this beginning of a line, to the line's end; empty: it is not
/// there.
[[nodiscard]] std::string_view rest_of_line(std::string_view prompt, std::string_view beginning);

/// What a prompt's line about a road user says, piece by piece, as it is written there. A piece is
/// empty where the line has none.
struct ActorLine {
  std::string along;      ///< "16 m ahead"
  std::string across;     ///< "6.4 m left"
  std::string intention;  ///< "lane change right 0.88"
  std::string conflict;   ///< "TTC 0.9 s"
  std::string risk;       ///< "risk 0.94"
};

/// @param line  without the name that it begins with
[[nodiscard]] ActorLine read_actor_line(std::string_view line);

}  // namespace saca::language_model
