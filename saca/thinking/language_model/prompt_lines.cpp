#include "saca/thinking/language_model/prompt_lines.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace saca::language_model {

std::string_view rest_of_line(std::string_view text, std::string_view beginning) {
  for (std::size_t at = text.find(beginning); at != std::string_view::npos;
       at = text.find(beginning, at + 1)) {
    if (at == 0 || text[at - 1] == '\n') {
      const std::string_view rest = text.substr(at + beginning.size());
      return rest.substr(0, rest.find('\n'));
    }
  }
  return {};
}

ActorLine read_actor_line(std::string_view line) {
  std::vector<std::string> parts;
  while (!line.empty()) {
    const std::size_t end = std::min(line.find(", "), line.size());
    if (end > 0) {
      parts.emplace_back(line.substr(0, end));
    }
    line.remove_prefix(std::min(end + 2, line.size()));
  }
  ActorLine read;
  for (std::string& part : parts) {
    if (part.ends_with("m ahead") || part.ends_with("m behind")) {
      read.along = std::move(part);
    } else if (part.ends_with("m left") || part.ends_with("m right")) {
      read.across = std::move(part);
    } else if (part.starts_with("TTC ")) {
      read.conflict = std::move(part);
    } else if (part.starts_with("risk ")) {
      read.risk = std::move(part);
    } else if (part.back() >= '0' && part.back() <= '9') {
      read.intention = std::move(part);
    }
  }
  return read;
}

}  // namespace saca::language_model
