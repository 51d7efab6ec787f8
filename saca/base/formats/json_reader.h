#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "saca/base/core/result.h"

namespace saca::formats {

/// Reads one object of a JSON document strictly: a key that is missing, of another type, out of
/// range or not known is refused. The first problem is remembered for the whole document; what is
/// read after it means nothing.
///
/// Messages name the key as "actors[2].speed_mps", what was wanted and what came.
class JsonReader {
 public:
  /// @param node      outlives the reader, as does `problem`
  /// @param path      of the node in the document: "actors[2]"; empty: the document itself
  /// @param problem   of the whole document; nullopt: none so far
  /// @param document  what messages call the document
  JsonReader(const nlohmann::json& node, std::string path, std::optional<Error>& problem,
             std::string_view document = "document");

  [[nodiscard]] double number(std::string_view key);
  [[nodiscard]] bool flag(std::string_view key);
  [[nodiscard]] std::string text(std::string_view key);
  [[nodiscard]] std::uint64_t integer(
      std::string_view key, std::uint64_t largest = std::numeric_limits<std::uint64_t>::max());

  /// Is the key there? It has still to be read.
  [[nodiscard]] bool has(std::string_view key) const { return node_.contains(key); }
  /// Is there something other than null? Where there is null or nothing, the key counts as read;
  /// nothing at all is refused.
  [[nodiscard]] bool has_value(std::string_view key);

  /// A word that `from` knows.
  /// @param known  how a message lists those words
  template <class Value>
  [[nodiscard]] Value word(std::string_view key, std::optional<Value> (*from)(std::string_view),
                           std::string_view known) {
    const nlohmann::json* value = find(key);
    if (value == nullptr) {
      return Value{};
    }
    const auto found =
        value->is_string() ? from(value->get_ref<const std::string&>()) : std::optional<Value>();
    if (!found) {
      reject(key, "want " + std::string(known) + ", got " + shown(*value));
    }
    return found.value_or(Value{});
  }

  /// The key "schema", which must be this word: what follows is read by its rules.
  void schema(std::string_view wanted);

  /// The object under `key`.
  [[nodiscard]] JsonReader object(std::string_view key);

  /// The array under `key`; nullptr when there is none, or one longer than `most`.
  [[nodiscard]] const nlohmann::json* list(
      std::string_view key, std::size_t most = std::numeric_limits<std::size_t>::max());
  /// An object of that array.
  [[nodiscard]] JsonReader element(std::string_view key, const nlohmann::json& list,
                                   std::size_t i) const;
  /// The array of finite numbers under `key`: as many as `numbers` has.
  void numbers(std::string_view key, std::span<double> numbers);
  /// The same of element `i` of a list of such arrays.
  void numbers(std::string_view key, const nlohmann::json& list, std::size_t i,
               std::span<double> numbers);
  /// Whatever is under `key`, for whoever reads it by other means; null when there is nothing.
  [[nodiscard]] const nlohmann::json& any(std::string_view key);

  /// Remembers this problem unless there was one before.
  void reject(std::string_view key, const std::string& why);

  /// Call it last: a key that nobody asked for is refused.
  void refuse_others();

  /// A value that came instead of the one wanted, short enough for a message.
  [[nodiscard]] static std::string shown(const nlohmann::json& value);

 private:
  void take_numbers(const std::string& key, const nlohmann::json& values,
                    std::span<double> numbers);
  const nlohmann::json* find(std::string_view key);
  [[nodiscard]] std::string name_of(std::string_view key) const;

  const nlohmann::json& node_;
  std::string path_;
  std::optional<Error>& problem_;
  std::string_view document_;
  std::vector<std::string> asked_;
};

}  // namespace saca::formats
