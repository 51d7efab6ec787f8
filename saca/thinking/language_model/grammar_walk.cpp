#include "saca/thinking/language_model/grammar_walk.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <utility>

#include "saca/thinking/language_model/gbnf.h"

namespace saca::language_model {
namespace {

using Node = GrammarWalk::Node;

constexpr int the_end = 0;
constexpr std::size_t most_nodes = 200'000;

bool is_name_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
         c == '_';
}

/// Turns rules into nodes, from the end of a text to its beginning: what a rule is followed by is
/// known when it is built, and built once for each such place.
class Builder {
 public:
  /// @return  the node of `root`; nullopt: not to be built
  std::optional<int> build(std::string_view grammar) {
    while (!grammar.empty()) {
      const std::size_t end = std::min(grammar.find('\n'), grammar.size());
      const std::string_view line = grammar.substr(0, end);
      grammar.remove_prefix(std::min(end + 1, grammar.size()));
      const std::size_t is = line.find(defined_as);
      if (line.empty()) {
        continue;
      }
      if (is == std::string_view::npos) {
        return std::nullopt;
      }
      rules_[line.substr(0, is)] = line.substr(is + defined_as.size());
    }
    nodes_.resize(1);
    const int root = rule("root", the_end);
    return is_refused_ ? std::nullopt : std::optional(root);
  }

  std::vector<Node> nodes() && { return std::move(nodes_); }

 private:
  static constexpr std::string_view defined_as = " ::= ";

  enum class Kind : std::uint8_t { literal, rule, group };
  struct Item {
    Kind kind = Kind::literal;
    std::string_view text;  ///< between the quotes or brackets; name of a rule
    bool may_be_missing = false;
  };

  int refuse() {
    is_refused_ = true;
    return the_end;
  }

  int add(Node node) {
    if (nodes_.size() >= most_nodes) {
      return refuse();
    }
    for (std::size_t i = 0; i < node.next.size(); ++i) {
      if (node.brief.value_or(i) == i) {
        const Node& next = nodes_[static_cast<std::size_t>(node.next[i])];
        node.longest_brief = std::max(node.longest_brief, next.longest_brief);
      }
    }
    node.longest_brief += node.is_byte ? 1 : 0;
    nodes_.push_back(std::move(node));
    return static_cast<int>(nodes_.size()) - 1;
  }

  int rule(std::string_view name, int next) {
    const auto found = rules_.find(name);
    if (is_refused_ || found == rules_.end() || within_.contains(name)) {
      return refuse();
    }
    const auto known = built_.find({name, next});
    if (known != built_.end()) {
      return known->second;
    }
    within_.insert(name);
    const int node = alternatives(found->second, next);
    within_.erase(name);
    built_[{name, next}] = node;
    return node;
  }

  int alternatives(std::string_view text, int next) {
    Node ways;
    std::vector<Item> sequence;
    const auto end_way = [&] {
      if (sequence.size() == 1 && sequence.front().kind == Kind::rule &&
          sequence.front().text == gbnf::conclusion_rule) {
        ways.brief = ways.next.size();
      }
      ways.next.push_back(this->sequence(sequence, next));
      sequence.clear();
    };
    while (!text.empty() && !is_refused_) {
      if (text.front() == ' ') {
        text.remove_prefix(1);
      } else if (text.front() == '|') {
        end_way();
        text.remove_prefix(1);
      } else {
        sequence.push_back(item(text));
      }
    }
    end_way();
    return ways.next.size() == 1 ? ways.next.front() : add(std::move(ways));
  }

  int sequence(const std::vector<Item>& items, int next) {
    for (auto it = items.rbegin(); it != items.rend() && !is_refused_; ++it) {
      const int before = it->kind == Kind::literal ? literal(it->text, next)
                         : it->kind == Kind::rule  ? rule(it->text, next)
                                                   : alternatives(it->text, next);
      next = it->may_be_missing ? add({.next = {before, next}, .brief = 1}) : before;
    }
    return next;
  }

  int literal(std::string_view text, int next) {
    std::string bytes;
    for (std::size_t i = 0; i < text.size(); ++i) {
      if (text[i] != '\\') {
        bytes += text[i];
      } else if (i + 1 < text.size() && text[i + 1] == 'n') {
        bytes += '\n';
        ++i;
      } else {
        return refuse();
      }
    }
    for (auto byte = bytes.rbegin(); byte != bytes.rend(); ++byte) {
      next = add({.is_byte = true, .byte = *byte, .next = {next}});
    }
    return next;
  }

  /// Takes the item that the text begins with from it.
  Item item(std::string_view& text) {
    Item found;
    std::size_t end = 0;
    if (text.front() == '"') {
      end = text.find('"', 1);
    } else if (text.front() == '(') {
      found.kind = Kind::group;
      end = end_of_group(text);
    } else {
      found.kind = Kind::rule;
      end = static_cast<std::size_t>(std::find_if_not(text.begin(), text.end(), is_name_character) -
                                     text.begin());
      found.text = text.substr(0, end);
      text.remove_prefix(end);
      if (end == 0) {
        refuse();
      }
      return found;
    }
    if (end >= text.size()) {
      refuse();
      return found;
    }
    found.text = text.substr(1, end - 1);
    text.remove_prefix(end + 1);
    if (text.starts_with('?')) {
      found.may_be_missing = true;
      text.remove_prefix(1);
    }
    return found;
  }

  /// @return  where the group closes that the text begins with; its size: nowhere
  static std::size_t end_of_group(std::string_view text) {
    int depth = 0;
    bool quoted = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
      quoted = quoted != (text[i] == '"');
      depth += quoted ? 0 : text[i] == '(' ? 1 : text[i] == ')' ? -1 : 0;
      if (depth == 0) {
        return i;
      }
    }
    return text.size();
  }

  std::map<std::string_view, std::string_view> rules_;
  std::map<std::pair<std::string_view, int>, int> built_;
  std::set<std::string_view> within_;  ///< rules that are being built
  std::vector<Node> nodes_;
  bool is_refused_ = false;
};

}  // namespace

std::optional<GrammarWalk> GrammarWalk::make(std::string_view grammar) {
  Builder builder;
  const std::optional<int> root = builder.build(grammar);
  if (!root) {
    return std::nullopt;
  }
  return GrammarWalk(std::make_shared<const Nodes>(std::move(builder).nodes()), *root);
}

std::vector<int> GrammarWalk::reachable(const std::vector<int>& nodes, Rest rest) const {
  std::vector<int> all;
  std::vector<int> left(nodes.rbegin(), nodes.rend());
  std::set<int> seen;
  while (!left.empty()) {
    const int index = left.back();
    left.pop_back();
    if (!seen.insert(index).second) {
      continue;
    }
    const Node& it = node(index);
    if (index == the_end || it.is_byte) {
      all.push_back(index);
    } else if (rest == Rest::brief && it.brief) {
      left.push_back(it.next[*it.brief]);
    } else {
      left.insert(left.end(), it.next.begin(), it.next.end());
    }
  }
  return all;
}

std::vector<int> GrammarWalk::behind(const std::vector<int>& all, char byte) const {
  std::vector<int> nodes;
  for (const int index : all) {
    if (const Node& it = node(index); it.is_byte && it.byte == byte) {
      nodes.push_back(it.next.front());
    }
  }
  return nodes;
}

std::string GrammarWalk::bytes_of(const std::vector<int>& all) const {
  std::string bytes;
  for (const int index : all) {
    if (const Node& it = node(index); it.is_byte) {
      bytes += it.byte;
    }
  }
  std::sort(bytes.begin(), bytes.end());
  bytes.erase(std::unique(bytes.begin(), bytes.end()), bytes.end());
  return bytes;
}

void GrammarWalk::take(std::string_view text) {
  for (const char byte : text) {
    here_ = behind(reachable(here_, Rest::any), byte);
  }
}

std::string GrammarWalk::possible(Rest rest) const {
  return bytes_of(reachable(here_, rest));
}

std::string GrammarWalk::forced(Rest rest) const {
  std::string text;
  std::vector<int> all = reachable(here_, rest);
  // Nobody has to go on where the text may end.
  while (std::find(all.begin(), all.end(), the_end) == all.end()) {
    const std::string bytes = bytes_of(all);
    if (bytes.size() != 1) {
      break;
    }
    text += bytes;
    all = reachable(behind(all, bytes.front()), rest);
  }
  return text;
}

std::size_t GrammarWalk::longest_brief() const {
  std::size_t longest = 0;
  for (const int index : here_) {
    longest = std::max(longest, node(index).longest_brief);
  }
  return longest;
}

}  // namespace saca::language_model
