#include "saca/lab/shell/line_description.h"

#include <algorithm>
#include <iterator>

#include "saca/base/core/contract.h"
#include "saca/base/core/csv.h"

namespace saca::shell {

std::vector<std::string> choices_of(std::string_view type) {
  const auto open = type.find('{');
  const auto close = type.rfind('}');
  if (open == type.npos || close == type.npos || close < open) {
    return {};
  }
  const auto words = fields_of(type.substr(open + 1, close - open - 1), ',');
  return {words.begin(), words.end()};
}

void describe_value(OptionDescription& option, const std::string& type, const std::string& usual) {
  option.value = type.substr(0, type.find(':'));
  const auto range = option.value.find(" in [");  // of numbers
  option.about += range == std::string::npos ? "" : " (" + option.value.substr(range + 1) + ")";
  option.value = option.value.substr(0, range);
  option.value = option.value.empty() ? "VALUE" : option.value;
  option.about += usual.empty() ? "" : " (default: " + usual + ")";
}

LineDescription part_of(const LineDescription& line, std::string_view name) {
  LineDescription part;
  const std::string below = std::string(name) + " ";
  std::copy_if(line.begin(), line.end(), std::back_inserter(part),
               [&](const CommandDescription& each) {
                 return each.name == name || each.name.starts_with(below);
               });
  return part;
}

const std::string& about(const LineDescription& line, const CommandDescription& outer,
                         std::string_view name) {
  const std::string full = outer.name + " " + std::string(name);
  const auto found =
      std::find_if(line.begin(), line.end(), [&](const auto& each) { return each.name == full; });
  expects(found != line.end(), "a command that is described");
  return found->about;
}

}  // namespace saca::shell
