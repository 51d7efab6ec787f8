#include "saca/lab/cases/chat_set_report.h"

#include <fmt/core.h>

namespace saca::cases {

nlohmann::json chat_set_json(const std::string& file, const ChatSetFigures& figures) {
  return {{"file", file},
          {"examples", figures.examples},
          {"tokens_at_most", figures.tokens},
          {"learnt_tokens_at_most", figures.learnt_tokens},
          {"longest_tokens_at_most", figures.longest}};
}

std::string chat_set_text(const std::string& file, const ChatSetFigures& figures) {
  return fmt::format(
      "{}: {} examples, up to {} tokens, of them up to {} to be learnt, up to {} in one\n", file,
      figures.examples, figures.tokens, figures.learnt_tokens, figures.longest);
}

}  // namespace saca::cases
