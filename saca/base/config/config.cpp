#include "saca/base/config/config.h"

#include <toml++/toml.h>

#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <utility>

#include "saca/base/config/toml_bounds.h"
#include "saca/base/core/other_unit.h"
#include "saca/base/core/printable.h"
#include "saca/base/core/suggestion.h"

namespace saca::config {

/// The parsed document, what was read of it, and what was wrong first.
struct DocumentState {
  std::string source;
  toml::table root;
  std::set<const toml::node*> read;
  std::map<const void*, std::vector<std::string>> asked;  ///< keys, by their tables
  std::optional<Error> error;
  const toml::table* lacking = nullptr;  ///< whose missing key is the error

  void ask(const void* table, std::string_view key) {
    std::vector<std::string>& keys = asked[table];
    if (std::find(keys.begin(), keys.end(), key) == keys.end()) {
      keys.emplace_back(key);
    }
  }

  void fail(Error::Code code, const toml::source_region& where, std::string_view key,
            std::string_view message) {
    if (error) {
      return;
    }
    std::string text = source + ":" + std::to_string(where.begin.line) + ": ";
    if (!key.empty()) {
      text += one_line(key, 80) + ": ";
    }
    error = Error{code, text + one_line(message, 500)};
  }
};

namespace {

constexpr std::size_t longest_text = std::size_t{64} << 10U;  // bytes; our notes have 2 KiB

const toml::table& table_of(const void* node) {
  return *static_cast<const toml::table*>(node);
}

std::string shown(double number) {
  std::ostringstream text;
  text << number;
  return text.str();
}

std::string shown(const Range& range) {
  constexpr double most = std::numeric_limits<double>::max();
  if (range.min > -most && range.max < most) {
    return shown(range.min) + " to " + shown(range.max);
  }
  if (range.min > -most) {
    return ">= " + shown(range.min);
  }
  return range.max < most ? "<= " + shown(range.max) : "a finite number";
}

std::string kind(const toml::node& node) {
  std::ostringstream text;
  text << node.type();
  return text.str();
}

/// The unit that a key carries, as far as people mistake it for another.
std::string_view unit_of(std::string_view key, const Range& range) {
  for (const auto& [end, unit] :
       {std::pair<std::string_view, std::string_view>{"_mps", "m/s"}, {"_s", "s"}, {"_kg", "kg"}}) {
    if (key.ends_with(end)) {
      return unit;
    }
  }
  constexpr double most_of_a_share = 1.5;  // the largest coefficients of friction are below
  return range.min >= 0.0 && range.max <= most_of_a_share && key.find("_m") == key.npos ? "-" : "";
}

double clamped_zero(const Range& range) {
  return std::min(std::max(0.0, range.min), range.max);
}

/// The key of a table that was likely meant by one that nobody asked for. One that is there is not
/// meant by another.
std::optional<std::string> meant_key(const DocumentState& state, const toml::table& table,
                                     std::string_view typed) {
  const auto asked = state.asked.find(&table);
  if (asked == state.asked.end()) {
    return std::nullopt;
  }
  std::vector<std::string> absent;
  std::copy_if(asked->second.begin(), asked->second.end(), std::back_inserter(absent),
               [&](const std::string& key) { return !table.contains(key); });
  return likely_meant(typed, absent);
}

std::string unknown_key(const DocumentState& state, const toml::table& table,
                        std::string_view typed) {
  if (const auto meant = meant_key(state, table, typed)) {
    return "unknown key; did you mean '" + *meant + "'?";
  }
  const auto asked = state.asked.find(&table);
  std::string list;
  if (asked != state.asked.end()) {
    for (const std::string& key : asked->second) {
      list += (list.empty() ? "; here stand " : ", ") + key;
    }
  }
  return "unknown key" + list;
}

/// A misspelt key leaves another one missing: then that is what is wrong.
void blame_misspelt(DocumentState& state) {
  if (state.lacking == nullptr) {
    return;
  }
  const toml::table& table = *state.lacking;
  state.lacking = nullptr;
  for (const auto& [key, node] : table) {
    if (!state.read.contains(&node) && meant_key(state, table, key.str())) {
      state.error.reset();
      state.fail(Error::Code::malformed, node.source(), key.str(),
                 unknown_key(state, table, key.str()));
      return;
    }
  }
}

/// Depth first, in the order of the file: the first entry that nobody asked for.
void find_unread(const toml::table& table, DocumentState& state) {
  const toml::node* first = nullptr;
  std::string_view name;
  for (const auto& [key, node] : table) {
    const bool unread = !state.read.contains(&node);
    if (unread && (first == nullptr || node.source().begin.line < first->source().begin.line)) {
      first = &node;
      name = key.str();
    }
  }
  if (first != nullptr) {
    state.fail(Error::Code::malformed, first->source(), name, unknown_key(state, table, name));
    return;
  }
  for (const auto& [key, node] : table) {
    if (const auto* inner = node.as_table()) {
      find_unread(*inner, state);
    } else if (const auto* list = node.as_array()) {
      for (const auto& item : *list) {
        if (const auto* entry = item.as_table()) {
          find_unread(*entry, state);
        }
      }
    }
  }
}

/// Marks the entry as read. nullptr, and an error if it is required, when there is none.
const toml::node* entry(DocumentState& state, const void* table, std::string_view key,
                        bool required) {
  state.ask(table, key);
  const toml::node* const found = table_of(table).get(key);
  if (found != nullptr) {
    state.read.insert(found);
  } else if (required && !state.error) {
    state.fail(Error::Code::malformed, table_of(table).source(), key, "missing");
    state.lacking = &table_of(table);
  }
  return found;
}

double checked_number(DocumentState& state, const toml::node& node, std::string_view key,
                      const Range& range) {
  const std::optional<double> number =
      node.is_number() ? node.value<double>() : std::optional<double>{};
  if (!number) {
    state.fail(Error::Code::malformed, node.source(), key, "want a number, got a " + kind(node));
    return clamped_zero(range);
  }
  if (!(*number >= range.min && *number <= range.max)) {  // so NaN is refused too
    state.fail(Error::Code::out_of_range, node.source(), key,
               "want " + shown(range) + ", got " + shown(*number) +
                   other_unit_hint(*number, range.min, range.max, unit_of(key, range)));
    return clamped_zero(range);
  }
  return *number;
}

}  // namespace

double Table::number(std::string_view key, Range range) {
  const toml::node* const node = entry(*document_, node_, key, true);
  return node == nullptr ? clamped_zero(range) : checked_number(*document_, *node, key, range);
}

std::optional<double> Table::optional_number(std::string_view key, Range range) {
  const toml::node* const node = entry(*document_, node_, key, false);
  if (node == nullptr) {
    return std::nullopt;
  }
  return checked_number(*document_, *node, key, range);
}

std::int64_t Table::integer(std::string_view key, std::int64_t min, std::int64_t max) {
  const toml::node* const node = entry(*document_, node_, key, true);
  if (node == nullptr) {
    return min;
  }
  const auto* number = node->as_integer();
  if (number == nullptr) {
    document_->fail(Error::Code::malformed, node->source(), key,
                    "want an integer, got a " + kind(*node));
    return min;
  }
  if (number->get() < min || number->get() > max) {
    document_->fail(Error::Code::out_of_range, node->source(), key,
                    "want " + std::to_string(min) + " to " + std::to_string(max) + ", got " +
                        std::to_string(number->get()));
    return min;
  }
  return number->get();
}

std::string Table::text(std::string_view key) {
  return entry(*document_, node_, key, true) == nullptr ? "" : optional_text(key).value_or("");
}

void Table::want_schema(std::string_view wanted) {
  const std::string schema = text("schema");
  if (schema != wanted) {
    reject("schema", "want \"" + std::string(wanted) + "\", got \"" + schema + "\"");
  }
}

std::string Table::plain_name(std::string_view key) {
  std::string name = text(key);
  constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyz0123456789_";
  if (name.empty() || name.find_first_not_of(letters) != std::string::npos) {
    reject(key, "want lower-case letters, digits and _, got \"" + name + "\"");
  }
  return name;
}

std::optional<std::string> Table::optional_text(std::string_view key) {
  const toml::node* const node = entry(*document_, node_, key, false);
  if (node == nullptr) {
    return std::nullopt;
  }
  if (!node->is_string()) {
    document_->fail(Error::Code::malformed, node->source(), key,
                    "want a text in quotes, got a " + kind(*node));
    return std::nullopt;
  }
  const std::string& text = node->as_string()->get();
  if (text.size() > longest_text) {
    document_->fail(Error::Code::out_of_range, node->source(), key,
                    "want a text of at most " + std::to_string(longest_text) + " bytes, got " +
                        std::to_string(text.size()));
    return std::nullopt;
  }
  return text;
}

bool Table::flag(std::string_view key, bool otherwise) {
  const toml::node* const node = entry(*document_, node_, key, false);
  if (node == nullptr) {
    return otherwise;
  }
  if (!node->is_boolean()) {
    document_->fail(Error::Code::malformed, node->source(), key,
                    "want true or false, got a " + kind(*node));
    return otherwise;
  }
  return node->as_boolean()->get();
}

std::vector<double> Table::numbers(std::string_view key, Range range,
                                   std::optional<std::size_t> size) {
  const toml::node* const node = entry(*document_, node_, key, true);
  std::vector<double> values(size.value_or(0), clamped_zero(range));
  if (node == nullptr) {
    return values;
  }
  const toml::array* const list = node->as_array();
  if (list == nullptr || (size && list->size() != *size)) {
    const std::string wanted = size ? std::to_string(*size) + " numbers" : "numbers";
    const std::string got = list == nullptr ? "a " + kind(*node) : std::to_string(list->size());
    document_->fail(Error::Code::malformed, node->source(), key,
                    "want [" + wanted + "], got " + got);
    return values;
  }
  values.clear();
  for (const toml::node& item : *list) {
    values.push_back(checked_number(*document_, item, key, range));
  }
  return values;
}

Table Table::table(std::string_view key) {
  static const toml::table nothing;
  const bool missing = entry(*document_, node_, key, true) == nullptr;
  return missing ? Table(document_, &nothing)
                 : optional_table(key).value_or(Table(document_, &nothing));
}

std::optional<Table> Table::optional_table(std::string_view key) {
  const toml::node* const node = entry(*document_, node_, key, false);
  if (node == nullptr) {
    return std::nullopt;
  }
  if (!node->is_table()) {
    document_->fail(Error::Code::malformed, node->source(), key,
                    "want a table, got a " + kind(*node));
    return std::nullopt;
  }
  return Table(document_, node->as_table());
}

std::vector<Table> Table::tables(std::string_view key) {
  const toml::node* const node = entry(*document_, node_, key, false);
  std::vector<Table> found;
  if (node == nullptr) {
    return found;
  }
  const toml::array* const list = node->as_array();
  if (list == nullptr) {
    document_->fail(Error::Code::malformed, node->source(), key,
                    "want [[" + std::string(key) + "]], got a " + kind(*node));
    return found;
  }
  for (const toml::node& item : *list) {
    if (!item.is_table()) {
      document_->fail(Error::Code::malformed, item.source(), key,
                      "want a table, got a " + kind(item));
      return {};
    }
    found.push_back(Table(document_, item.as_table()));
  }
  return found;
}

bool Table::has(std::string_view key) const {
  document_->ask(node_, key);
  return table_of(node_).contains(key);
}

void Table::reject(std::string_view key, std::string_view message) {
  const toml::node* const node = table_of(node_).get(key);
  const toml::source_region& where = node != nullptr ? node->source() : table_of(node_).source();
  document_->fail(Error::Code::out_of_range, where, key, message);
}

Result<Document> Document::parse(std::string_view text, std::string_view source) {
  auto state = std::make_shared<DocumentState>();
  state->source = source;
  if (const auto excess = beyond(TomlBounds{}, text)) {
    return Error{Error::Code::malformed,
                 std::string(source) + ":" + std::to_string(excess->line) + ": " + excess->message};
  }
  try {
    state->root = toml::parse(text, source);
  } catch (const toml::parse_error& problem) {
    return Error{Error::Code::malformed, std::string(source) + ":" +
                                             std::to_string(problem.source().begin.line) +
                                             ": not TOML: " + one_line(problem.description())};
  }
  return Document(std::move(state));
}

Table Document::root() const {
  return {state_, &state_->root};
}

std::optional<Error> Document::error() const {
  if (!state_->error) {
    find_unread(state_->root, *state_);
  }
  blame_misspelt(*state_);
  return state_->error;
}

}  // namespace saca::config
