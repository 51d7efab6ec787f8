#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
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

  /// Which texts are meant, of those that the grammar allows from here on.
  enum class Rest : std::uint8_t {
    any,
    /// Those without what may be left out: optional groups and, where one alternative is the rule
    /// `gbnf::conclusion_rule` alone, the others. What has begun is said to its end.
    brief,
  };

  /// With what every such text goes on; empty where there is a choice, and at the text's end.
  [[nodiscard]] std::string forced(Rest rest = Rest::any) const;
  /// With which bytes they go on, each once, in their order.
  [[nodiscard]] std::string possible(Rest rest = Rest::any) const;
  /// Of how many bytes the rest of a brief text is at most [B].
  [[nodiscard]] std::size_t longest_brief() const;

  /// A byte and what comes after it, or several ways to go on; the first one of all is the end.
  struct Node {
    bool is_byte = false;
    char byte = 0;
    std::vector<int> next;
    std::optional<std::size_t> brief = {};  ///< which of `next` is the brief way; nullopt: all
    std::size_t longest_brief = 0;          ///< bytes from here to the end, by brief ways
  };

 private:
  using Nodes = std::vector<Node>;

  GrammarWalk(std::shared_ptr<const Nodes> nodes, int root)
      : nodes_(std::move(nodes)), here_{root} {}
  [[nodiscard]] const Node& node(int index) const {
    return (*nodes_)[static_cast<std::size_t>(index)];
  }
  /// The bytes that may come next, and the end, each once: what can be reached from these nodes
  /// without a byte.
  [[nodiscard]] std::vector<int> reachable(const std::vector<int>& nodes, Rest rest) const;
  [[nodiscard]] std::vector<int> behind(const std::vector<int>& all, char byte) const;
  [[nodiscard]] std::string bytes_of(const std::vector<int>& all) const;

  std::shared_ptr<const Nodes> nodes_;  ///< not changed once made: copies share it
  std::vector<int> here_;               ///< nodes behind the last byte
};

}  // namespace saca::language_model
