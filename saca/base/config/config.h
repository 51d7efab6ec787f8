#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "saca/base/core/result.h"

namespace saca::config {

/// Values that a key may have, both ends included.
struct Range {
  double min = -std::numeric_limits<double>::max();
  double max = std::numeric_limits<double>::max();
};

struct DocumentState;

/// One table of a TOML document, read strictly: the first thing that is wrong is remembered and
/// told by `Document::error()`; until then the reads below return values inside their ranges, so
/// that a reader can be written without a branch per key.
class Table {
 public:
  /// A finite number (integer or float) in `range`; the key must be there.
  [[nodiscard]] double number(std::string_view key, Range range = {});
  /// Likewise, or nullopt when the key is missing.
  [[nodiscard]] std::optional<double> optional_number(std::string_view key, Range range = {});
  /// An integer in [min, max].
  [[nodiscard]] std::int64_t integer(std::string_view key, std::int64_t min, std::int64_t max);
  /// A text of at most 64 KiB.
  [[nodiscard]] std::string text(std::string_view key);
  [[nodiscard]] std::optional<std::string> optional_text(std::string_view key);
  /// Rejects the document unless its text under `schema` is this.
  void want_schema(std::string_view wanted);
  /// A text that may be a file's name everywhere: lower-case letters, digits and `_`, at least one.
  [[nodiscard]] std::string plain_name(std::string_view key);
  /// @return  `otherwise` when the key is missing
  [[nodiscard]] bool flag(std::string_view key, bool otherwise);
  /// An array of finite numbers in `range`.
  /// @param size  how many there must be; nullopt: any
  [[nodiscard]] std::vector<double> numbers(std::string_view key, Range range = {},
                                            std::optional<std::size_t> size = std::nullopt);
  /// The table under `key`; it must be there.
  [[nodiscard]] Table table(std::string_view key);
  [[nodiscard]] std::optional<Table> optional_table(std::string_view key);
  /// The array of tables `[[key]]`; empty when there is none.
  [[nodiscard]] std::vector<Table> tables(std::string_view key);
  [[nodiscard]] bool has(std::string_view key) const;

  /// Remembers "file:line: key: message" as what is wrong, unless something was before: for rules
  /// that join several keys. An empty key blames the table.
  void reject(std::string_view key, std::string_view message);

 private:
  friend class Document;
  Table(std::shared_ptr<DocumentState> document, const void* node)
      : document_(std::move(document)), node_(node) {}

  std::shared_ptr<DocumentState> document_;
  const void* node_;  ///< the library's table, kept out of this header
};

/// A TOML document that is read strictly.
class Document {
 public:
  /// @param source  name for messages, usually the path
  /// @return        Error::Code::malformed, naming source and line, when it is not TOML or breaks
  ///                the bounds of `TomlBounds`
  [[nodiscard]] static Result<Document> parse(std::string_view text, std::string_view source);

  [[nodiscard]] Table root() const;

  /// What was wrong first: a key that was missing, of the wrong type, out of range, or (once all is
  /// read) one that nobody asked for. Call it last. nullopt when all is well.
  ///
  /// Of a key that nobody asked for it tells which was likely meant (core/suggestion.h), else which
  /// there are; so it does where that key leaves another one missing.
  [[nodiscard]] std::optional<Error> error() const;

 private:
  explicit Document(std::shared_ptr<DocumentState> state) : state_(std::move(state)) {}
  std::shared_ptr<DocumentState> state_;
};

}  // namespace saca::config
