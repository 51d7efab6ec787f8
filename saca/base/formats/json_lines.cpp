#include "saca/base/formats/json_lines.h"

#include <algorithm>
#include <cstdint>

#include "saca/base/formats/json_reader.h"
#include "saca/base/formats/json_text.h"

namespace saca::formats {
namespace {

using nlohmann::json;

Error at_line(const std::string& name, std::size_t line, const std::string& why) {
  return {Error::Code::malformed, name + ": line " + std::to_string(line) + ": " + why};
}

}  // namespace

std::string first_json_line(std::string_view schema, std::string_view word, std::size_t count) {
  return json{{"schema", schema}, {std::string(word), count}}.dump() + '\n';
}

std::optional<Error> read_json_lines(
    std::string_view text, const std::string& name, std::string_view schema,
    const std::string& word, const std::function<std::optional<std::string>(const json&)>& take) {
  std::uint64_t wanted = 0;
  std::uint64_t taken = 0;
  std::size_t line = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const auto parsed = parse_json(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    ++line;
    if (!parsed.has_value()) {
      return at_line(name, line, parsed.error().message);
    }
    if (line == 1) {
      std::optional<Error> problem;
      JsonReader header(parsed.value(), "", problem, "first line");
      header.schema(schema);
      wanted = header.integer(word);
      header.refuse_others();
      if (problem) {
        return at_line(name, line, problem->message);
      }
      continue;
    }
    if (const auto refused = take(parsed.value())) {
      return at_line(name, line, *refused);
    }
    ++taken;
  }
  if (line == 0) {
    return at_line(name, 1, "want " + word + ", got nothing");
  }
  if (taken != wanted) {
    return at_line(name, line + 1,
                   "want " + std::to_string(wanted) + " " + word + ", as line 1 says, got " +
                       std::to_string(taken));
  }
  return std::nullopt;
}

}  // namespace saca::formats
