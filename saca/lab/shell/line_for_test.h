#pragma once

#include "saca/lab/shell/line_description.h"

namespace saca::shell {

/// A program with two commands, one of which has a command of its own.
inline LineDescription small_line() {
  return {{.name = "saca",
           .about = "Avoids crashes.",
           .options = {{.names = {"-q", "--quiet"}, .about = "Says nothing"}},
           .positionals = {},
           .commands = {"run", "memory"}},
          {.name = "saca run",
           .about = "Play it: don't wait",
           .options = {{.names = {"--pace"},
                        .value = "TEXT",
                        .choices = {"real", "lockstep"},
                        .about = "How fast"},
                       {.names = {"--report"}, .value = "TEXT", .about = "Where the page goes"}},
           .positionals = {{.names = {"scenario"}, .about = "A file", .needed = true}},
           .commands = {}},
          {.name = "saca memory",
           .about = "What was met",
           .options = {},
           .positionals = {},
           .commands = {"list"}},
          {.name = "saca memory list",
           .about = "All cases",
           .options = {{.names = {"--at-s"}, .value = "FLOAT", .about = "When"}},
           .positionals = {{.names = {"order"}, .choices = {"old", "new"}}},
           .commands = {}}};
}

}  // namespace saca::shell
