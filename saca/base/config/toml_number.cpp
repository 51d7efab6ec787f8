#include "saca/base/config/toml_number.h"

#include <toml++/toml.h>

#include <cmath>
#include <sstream>

#include "saca/base/config/toml_bounds.h"
#include "saca/base/core/csv.h"

namespace saca::config {
namespace {

std::optional<toml::table> parsed(std::string_view text) {
  if (beyond(TomlBounds{}, text)) {
    return std::nullopt;
  }
  try {
    return toml::parse(text);
  } catch (const toml::parse_error&) {
    return std::nullopt;
  }
}

/// A place in a list; nullopt: the part is a key.
std::optional<std::size_t> place_from(std::string_view part) {
  constexpr std::size_t most_digits = 9;
  if (part.empty() || part.size() > most_digits ||
      part.find_first_not_of("0123456789") != std::string_view::npos) {
    return std::nullopt;
  }
  return std::stoul(std::string(part));
}

/// What stands under one part of a path; nullptr: nothing.
toml::node* below(toml::node& node, std::string_view part) {
  if (toml::table* const table = node.as_table()) {
    return table->get(part);
  }
  toml::array* const list = node.as_array();
  const auto place = place_from(part);
  return list != nullptr && place ? list->get(*place) : nullptr;
}

/// Likewise, with a table made where there is none.
toml::node* below_or_made(toml::node& node, std::string_view part) {
  if (toml::table* const table = node.as_table(); table != nullptr && !table->contains(part)) {
    return &table->insert(part, toml::table()).first->second;
  }
  return below(node, part);
}

Error leads_nowhere(std::string_view path) {
  return {Error::Code::malformed, std::string(path) + ": no number can stand there"};
}

bool set(toml::node& holder, std::string_view part, double value) {
  if (toml::table* const table = holder.as_table()) {
    const toml::node* const there = table->get(part);
    if (there != nullptr && !there->is_number()) {
      return false;
    }
    if (there != nullptr && there->is_integer() && value == std::round(value)) {
      table->insert_or_assign(part, static_cast<std::int64_t>(value));
    } else {
      table->insert_or_assign(part, value);
    }
    return true;
  }
  toml::array* const list = holder.as_array();
  const auto place = place_from(part);
  if (list == nullptr || !place || *place >= list->size() || !list->get(*place)->is_number()) {
    return false;
  }
  list->replace(list->cbegin() + static_cast<std::ptrdiff_t>(*place), value);
  return true;
}

}  // namespace

std::optional<double> number_at(std::string_view text, std::string_view path) {
  auto root = parsed(text);
  toml::node* node = root ? &*root : nullptr;
  for (const std::string_view part : fields_of(path, '.')) {
    node = node == nullptr ? nullptr : below(*node, part);
  }
  return node != nullptr && node->is_number() ? node->value<double>() : std::nullopt;
}

Result<std::string> with_number(std::string_view text, std::string_view path, double value) {
  auto root = parsed(text);
  if (!root) {
    return leads_nowhere(path);
  }
  const std::vector<std::string_view> parts = fields_of(path, '.');
  toml::node* node = &*root;
  for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
    node = node == nullptr ? nullptr : below_or_made(*node, parts[i]);
  }
  if (node == nullptr || !set(*node, parts.back(), value)) {
    return leads_nowhere(path);
  }
  std::ostringstream out;
  out << toml::toml_formatter(*root);
  return out.str();
}

}  // namespace saca::config
