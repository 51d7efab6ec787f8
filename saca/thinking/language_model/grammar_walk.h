#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace saca::language_model {

/// Follows a text through a grammar and tells what must come next: where the grammar leaves no
/// choice, nobody need ask a model.
///
/// Knows the part of llama.cpp's notation (GBNF) that `reply_grammar` writes: a rule a line, of
/// alternatives of literals, rules and groups, of which a group may be optional; no rule is a part
/// of itself. Bytes are compared, not characters.
class GrammarWalk {
 public:
  /// At the beginning of a text.
  /// @return  nullopt where the grammar uses more of the notation, has no rule `root`, or is larger
  ///          than any reply's
  [[nodiscard]] static std::optional<GrammarWalk> make(std::string_view grammar);

  /// Goes on over a part of the text. What the grammar does not allow ends the walk: from there on
  /// nothing must come.
  void take(std::string_view text);

  /// With what every text of the grammar that begins so far goes on; empty where there is a choice,
  /// and at the text's end.
  [[nodiscard]] std::string forced() const;
  /// With which bytes it may go on, each once, in their order.
  [[nodiscard]] std::string possible() const;

  /// A byte and what comes after it, or several ways to go on; the first one of all is the end.
  struct Node {
    bool is_byte = false;
    char byte = 0;
    std::vector<int> next;
  };

 private:
  using Nodes = std::vector<Node>;

  GrammarWalk(std::shared_ptr<const Nodes> nodes, int root);
  /// Adds a node, or in its place all that can be reached from it without a byte, each once.
  static void add(const Nodes& nodes, int first, std::vector<int>& all);
  [[nodiscard]] std::vector<int> behind(const std::vector<int>& here, char byte) const;
  [[nodiscard]] std::string bytes_at(const std::vector<int>& here) const;

  std::shared_ptr<const Nodes> nodes_;  ///< not changed once made: copies share it
  std::vector<int> here_;               ///< bytes that may come next, and the end
};

}  // namespace saca::language_model
