#include "apps/saca/command.h"

#include <cstdlib>

#include "saca/lab/installation/shipped_files.h"
#include "saca/lab/long_work/output_file.h"

namespace saca::app {

void complain(const std::string& message) {
  constexpr std::size_t longest_complaint = 8'000;  // characters; a path has up to 4096
  std::fputs(fmt::format("saca: {}\n", one_line(message, longest_complaint)).c_str(),
             stderr);  // which may be closed
}

void complain_of(const std::vector<std::string>& messages) {
  for (const std::string& message : messages) {
    complain(message);
  }
}

void refuse(ExitCode code, const std::string& message) {
  complain(message);
  throw Exit{code};
}

void refuse(const Error& problem, ExitCode too_late) {
  refuse(problem.code == Error::Code::unwritable ? cannot_write
         : problem.code == Error::Code::too_late ? too_late
                                                 : bad_input,
         problem.message);
}

void need(const std::optional<Error>& problem) {
  if (problem) {
    refuse(*problem);
  }
}

void need_writable(std::initializer_list<fs::path> files) {
  need(long_work::why_outputs_unwritable(files));
}

bool is_same_file(const fs::path& one, const fs::path& other) {
  std::error_code problem;
  if (fs::equivalent(one, other, problem)) {
    return true;
  }
  const fs::path at = fs::weakly_canonical(fs::absolute(one, problem), problem);
  return !at.empty() && at == fs::weakly_canonical(fs::absolute(other, problem), problem);
}

void need_distinct(const std::vector<NamedFile>& outputs, const std::vector<NamedFile>& inputs) {
  std::vector<NamedFile> taken = inputs;
  for (const NamedFile& output : outputs) {
    std::error_code problem;
    if (output.file.empty() || fs::is_character_file(output.file, problem)) {
      continue;
    }
    for (const NamedFile& other : taken) {
      if (!other.file.empty() && is_same_file(output.file, other.file)) {
        refuse(wrong_command_line, fmt::format("{}: want another file than {}, got {}", output.what,
                                               other.what, output.file.string()));
      }
    }
    taken.push_back(output);
  }
}

void write(const fs::path& file, const std::string& text) {
  need(long_work::write_output(file, text));
}

void tell_meanwhile(bool as_json, const std::string& text) {
  if (!as_json) {
    app::print("{}", text);
    std::fflush(stdout);
  }
}

nlohmann::json with_meta(nlohmann::json figures, const std::string& command) {
  figures["meta.command"] = "saca " + command;
  figures["meta.version"] = SACA_VERSION;
  return figures;
}

Settings& settings() {
  static Settings all;
  return all;
}

long_work::ProgressDisplay progress_display() {
  return settings().quiet ? long_work::ProgressDisplay::silent : long_work::ProgressDisplay::shown;
}

namespace {

installation::Installation find_here() {
  std::error_code problem;
  const fs::path program = fs::read_symlink("/proc/self/exe", problem);
  if (problem) {
    refuse(bad_input, "/proc/self/exe: " + problem.message());
  }
  auto found = need(installation::find_installation(program));
  found.cache = settings().cache.empty() ? installation::usual_cache() : fs::path(settings().cache);
  found.version = SACA_VERSION;
  found.commit = built_from();
  if (const char* const key = std::getenv("SACA_LLM_KEY")) {
    found.model_key = key;
  }
  found.display = progress_display();
  found.notice = complain;
  return found;
}

}  // namespace

const installation::Installation& here() {
  static const installation::Installation found = find_here();
  return found;
}

installation::Inputs read_inputs(const std::string& car) {
  return need(installation::read_inputs(here(), car));
}

installation::ScenarioInputs read_scenario_inputs(const std::string& scenario) {
  return need(installation::read_scenario_inputs(here(), scenario));
}

NamedFile car_file(const std::string& car) {
  return {"--car", need(installation::find_car(here(), car))};
}

CLI::App& add_group(CLI::App& parent, const std::string& name, const std::string& about) {
  CLI::App* const group = parent.add_subcommand(name, about);
  group->require_subcommand(1);
  return *group;
}

}  // namespace saca::app
