#pragma once

#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/base/formats/json_reader.h"
#include "saca/base/formats/json_text.h"

namespace saca::long_work {

/// What one encounter or case gave, as a row of long work (resumable_work.h).
template <class Item>
struct ItemsRow {
  std::vector<Item> items;
  std::string problem;  ///< why it could not be played or asked; else empty
};

/// As a line of a journal; each item by its own `to_json`.
template <class Item>
[[nodiscard]] std::string items_line(const ItemsRow<Item>& row) {
  nlohmann::json items = nlohmann::json::array();
  for (const Item& one : row.items) {
    items.push_back(to_json(one));
  }
  return nlohmann::json{{"items", std::move(items)}, {"problem", row.problem}}.dump();
}

/// And back.
/// @param read  an item from its document
template <class Item, class Read>
[[nodiscard]] Result<ItemsRow<Item>> items_row(const std::string& line, const Read& read) {
  const auto parsed = formats::parse_json(line);
  if (!parsed.has_value()) {
    return parsed.error();
  }
  std::optional<Error> problem;
  formats::JsonReader reader(parsed.value(), "", problem, "line");
  ItemsRow<Item> row{.items = {}, .problem = reader.text("problem")};
  const nlohmann::json* const items = reader.list("items");
  reader.refuse_others();
  for (std::size_t i = 0; items != nullptr && i < items->size(); ++i) {
    auto one = read((*items)[i]);
    if (!one.has_value()) {
      return one.error();
    }
    row.items.push_back(std::move(one).value());
  }
  if (problem) {
    return *problem;
  }
  return row;
}

/// What all rows gave.
template <class Item>
struct AllItems {
  std::vector<Item> items;            ///< in the order of the rows
  std::vector<std::string> problems;  ///< of the rows that have one
};

template <class Item>
[[nodiscard]] AllItems<Item> all_items(std::vector<ItemsRow<Item>> rows) {
  AllItems<Item> all;
  for (ItemsRow<Item>& row : rows) {
    if (!row.problem.empty()) {
      all.problems.push_back(std::move(row.problem));
    }
    std::move(row.items.begin(), row.items.end(), std::back_inserter(all.items));
  }
  return all;
}

}  // namespace saca::long_work
