#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <random>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace saca::language_model {

/// Reads the part of llama.cpp's grammar notation that `reply_grammar` writes: a rule a line, of
/// alternatives of literals, rules and groups, which may be optional.
class Gbnf {
 public:
  explicit Gbnf(std::string_view text) {
    while (!text.empty()) {
      const std::size_t end = text.find('\n');
      const std::string_view line = text.substr(0, end);
      const std::size_t is = line.find(" ::= ");
      rules_[std::string(line.substr(0, is))] = line.substr(is + 5);
      text.remove_prefix(end + 1);
    }
  }

  /// Whether `text` is one of its texts.
  [[nodiscard]] bool accepts(std::string_view text) const {
    return ends_of("root", text, {0}).contains(text.size());
  }

  /// One of its texts, drawn.
  [[nodiscard]] std::string drawn(std::mt19937_64& random) const {
    return drawn_of(rule("root"), random);
  }

 private:
  using Ends = std::set<std::size_t>;
  enum class Kind : std::uint8_t { literal, rule, group };
  struct Item {
    Kind kind = Kind::literal;
    std::string text;  ///< of a literal; name of a rule; what stands in a group
    bool may_be_missing = false;
  };
  using Sequence = std::vector<Item>;

  [[nodiscard]] const std::string& rule(const std::string& name) const {
    EXPECT_TRUE(rules_.contains(name)) << name;
    return rules_.at(name);
  }

  static std::vector<Sequence> alternatives(std::string_view text) {
    std::vector<Sequence> all(1);
    for (std::size_t i = 0; i < text.size();) {
      if (text[i] == ' ') {
        ++i;
      } else if (text[i] == '|') {
        all.emplace_back();
        ++i;
      } else if (text[i] == '"') {
        const std::size_t end = text.find('"', i + 1);
        all.back().push_back({Kind::literal, unescaped(text.substr(i + 1, end - i - 1))});
        i = end + 1;
      } else if (text[i] == '(') {
        const std::size_t end = end_of_group(text, i);
        all.back().push_back({Kind::group, std::string(text.substr(i + 1, end - i - 1))});
        i = end + 1;
        if (i < text.size() && text[i] == '?') {
          all.back().back().may_be_missing = true;
          ++i;
        }
      } else {
        const std::size_t end = std::min(text.find(' ', i), text.size());
        all.back().push_back({Kind::rule, std::string(text.substr(i, end - i))});
        i = end;
      }
    }
    return all;
  }

  static std::string unescaped(std::string_view text) {
    std::string plain;
    for (std::size_t i = 0; i < text.size(); ++i) {
      const bool line_end = text.substr(i).starts_with("\\n");
      plain += line_end ? '\n' : text[i];
      i += line_end ? 1 : 0;
    }
    return plain;
  }

  static std::size_t end_of_group(std::string_view text, std::size_t open) {
    int depth = 0;
    bool quoted = false;
    for (std::size_t i = open; i < text.size(); ++i) {
      quoted = quoted != (text[i] == '"');
      depth += quoted ? 0 : text[i] == '(' ? 1 : text[i] == ')' ? -1 : 0;
      if (depth == 0 && !quoted) {
        return i;
      }
    }
    ADD_FAILURE() << "a group without an end: " << text;
    return text.size();
  }

  [[nodiscard]] Ends ends_of(const std::string& name, std::string_view text,
                             const Ends& begins) const {
    return ends_of_any(alternatives(rule(name)), text, begins);
  }

  [[nodiscard]] Ends ends_of_any(const std::vector<Sequence>& ways, std::string_view text,
                                 const Ends& begins) const {
    Ends all;
    for (const Sequence& way : ways) {
      Ends here = begins;
      for (const Item& item : way) {
        Ends next = item.kind == Kind::literal ? ends_of_literal(item.text, text, here)
                    : item.kind == Kind::rule  ? ends_of(item.text, text, here)
                                               : ends_of_any(alternatives(item.text), text, here);
        if (item.may_be_missing) {
          next.insert(here.begin(), here.end());
        }
        here = std::move(next);
      }
      all.insert(here.begin(), here.end());
    }
    return all;
  }

  static Ends ends_of_literal(const std::string& literal, std::string_view text,
                              const Ends& begins) {
    Ends all;
    for (const std::size_t at : begins) {
      if (text.substr(at).starts_with(literal)) {
        all.insert(at + literal.size());
      }
    }
    return all;
  }

  [[nodiscard]] std::string drawn_of(const std::string& text, std::mt19937_64& random) const {
    const auto below = [&](std::size_t count) {
      return std::uniform_int_distribution<std::size_t>(0, count - 1)(random);
    };
    const std::vector<Sequence> ways = alternatives(text);
    std::string drawn;
    for (const Item& item : ways.at(below(ways.size()))) {
      if (item.may_be_missing && below(2) == 0) {
        continue;
      }
      drawn += item.kind == Kind::literal ? item.text
               : item.kind == Kind::rule  ? drawn_of(rule(item.text), random)
                                          : drawn_of(item.text, random);
    }
    return drawn;
  }

  std::map<std::string, std::string> rules_;
};

}  // namespace saca::language_model
