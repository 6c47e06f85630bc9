// Runs golden transcripts: what a user could have typed and what came back.
//
//   # One sentence: the behaviour that this transcript shows.
//   $ orb check bad.bas
//   bad.bas:1:4: error[…]: …
//   [stderr]
//   what went to stderr
//   [exit 1]
//   === bad.bas
//   10 rgb 255,0,0
//
// A step is a line `$ COMMAND` (run by sh in a fresh folder that holds the input files), the
// expected stdout, `[stderr]` and the expected stderr if there is any, and `[exit N]` unless it is
// 0. `~` is an empty folder for each transcript. Output without a final line end is followed by a
// line `[no newline]`. Input files come last: `=== NAME`, or `=== NAME hex` for bytes, or `=== NAME
// bare` for a text without its last line end. `--update` rewrites the expectations: read the diff.
// `--pseudo` prints findings in the pseudo-locale and removes its marks again: if a transcript then
// differs, a translated text was cut; the last line counts the texts. `--advice` compares nothing,
// but follows the advice of each command: tests/golden/advice.h.
//
// A file that ends in `.md` is a page of the documentation: tests/docs/page.h.

#include "base/bytes.h"
#include "tests/docs/page.h"
#include "tests/golden/advice.h"
#include "tests/golden/files.h"
#include "tests/golden/shell.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace fs = std::filesystem;

namespace {

struct Step {
  std::string command;
  std::string out;
  std::string err;
  int exit = 0;

  friend bool operator==(const Step&, const Step&) = default;
};

struct Input {
  std::string name;
  std::string kind; // empty, "hex" or "bare"
  std::string text;
};

struct Transcript {
  std::string head; // the comment lines, kept as they are
  std::vector<Step> steps;
  std::vector<Input> inputs;
};

/// True for lines of output that look like the runner's own marks: they get a backslash.
bool needs_escape(const std::string& line) {
  return line.starts_with("$ ") || line.starts_with("[stderr]") || line.starts_with("[exit ") ||
         line.starts_with("[no newline]") || line.starts_with("=== ") || line.starts_with("\\");
}

std::string escape(const std::string& output) {
  std::string text;
  for (const auto& line : files::lines(output))
    text += (needs_escape(line) ? "\\" : "") + line + "\n";
  if (!output.empty() && output.back() != '\n')
    text += "[no newline]\n";
  return text;
}

Transcript parse(const std::string& text) {
  Transcript transcript;
  std::string* sink = &transcript.head;
  for (const auto& line : files::lines(text)) {
    const bool in_input = !transcript.inputs.empty();
    if (line.starts_with("=== ")) {
      std::istringstream words(line.substr(4));
      Input input;
      words >> input.name >> input.kind;
      transcript.inputs.push_back(input);
      sink = &transcript.inputs.back().text;
    } else if (in_input) {
      *sink += line + "\n";
    } else if (line.starts_with("$ ")) {
      transcript.steps.push_back({line.substr(2), {}, {}, 0});
      sink = &transcript.steps.back().out;
    } else if (line == "[stderr]" && !transcript.steps.empty()) {
      sink = &transcript.steps.back().err;
    } else if (line.starts_with("[exit ") && !transcript.steps.empty()) {
      transcript.steps.back().exit = std::atoi(line.c_str() + 6);
    } else if (line == "[no newline]" && !sink->empty()) {
      sink->pop_back();
    } else {
      *sink += (line.starts_with("\\") ? line.substr(1) : line) + "\n";
    }
  }
  return transcript;
}

std::string print(const Transcript& transcript) {
  std::string text = transcript.head;
  for (const auto& step : transcript.steps) {
    text += "$ " + step.command + "\n" + escape(step.out);
    if (!step.err.empty())
      text += "[stderr]\n" + escape(step.err);
    if (step.exit != 0)
      text += fmt::format("[exit {}]\n", step.exit);
  }
  for (const auto& input : transcript.inputs)
    text += "=== " + input.name + (input.kind.empty() ? "" : " " + input.kind) + "\n" + input.text;
  return text;
}

std::string content_of(const Input& input) {
  if (input.kind == "hex") {
    const auto bytes = orb::from_hex(input.text);
    return bytes ? std::string(orb::as_text(*bytes)) : "bad hex in the transcript";
  }
  if (input.kind == "bare" && input.text.ends_with("\n"))
    return input.text.substr(0, input.text.size() - 1);
  return input.text;
}

/// Creates `work` for the files in `folder`, and next to it an empty home, so that personal
/// settings have no effect and nothing remains.
fs::path settle(const fs::path& folder) {
  const auto home = folder / "home";
  const auto work = folder / "work";
  fs::create_directory(home);
  fs::create_directory(work);
  fs::permissions(folder, fs::perms(0755)); // for transcripts that drop root's privileges
  ::setenv("HOME", home.c_str(), 1);
  return work;
}

/// Replaces the names of folders that differ in each run.
void replace_folders(std::string& text, const fs::path& work) {
  files::replace_all(text, work.string(), "$PWD");
  files::replace_all(text, (work.parent_path() / "home").string(), "$HOME");
}

Step run(const std::string& command, const fs::path& folder, const fs::path& logs) {
  const auto out = logs / "stdout";
  const auto err = logs / "stderr";
  const auto line = fmt::format("cd '{}' && exec </dev/null >'{}' 2>'{}'; {}", folder.string(),
                                out.string(), err.string(), command);
  const int status = shell::run(line);
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  Step step{command, files::read(out), files::read(err), code};
  for (auto* text : {&step.out, &step.err})
    replace_folders(*text, folder);
  return step;
}

/// Removes the marks of the pseudo-locale and returns how many texts had them.
std::size_t without_marks(std::string& text) {
  for (const char* mark : {"⟧", "M-bM-^_M-&", "M-bM-^_M-'"}) // as `cat -v` shows them, too
    files::replace_all(text, mark, "");
  return files::replace_all(text, "⟦", "");
}
std::size_t marks_seen = 0; ///< in all transcripts

struct Options {
  bool update = false;
  bool pseudo = false;
  bool advice = false;
  fs::path orb;
  fs::path root;
  std::vector<fs::path> paths;
};

/// Returns true if the file is unchanged, or was updated.
bool compare(const fs::path& path, const std::string& before, const std::string& after,
             const Options& options) {
  if (before == after)
    return true;
  if (shell::was_interrupted()) // the output is then incomplete
    return false;
  if (options.update) {
    files::write(path, after);
    fmt::print("updated {}\n", path.string());
    return true;
  }
  const files::Scratch folder;
  files::write(folder.path() / "expected", before);
  files::write(folder.path() / "actual", after);
  fmt::print("FAILED {}\n", path.string());
  std::fflush(stdout);
  const auto diff = fmt::format("cd '{}' && diff -u expected actual", folder.path().string());
  shell::run(diff);
  return false;
}

/// Follows the advice in the help of all commands.
bool follow_help() {
  const files::Scratch logs;
  const auto problems =
      advice::problems_of_help([&](const std::string& command, const fs::path& folder) {
        const auto ran = run(command, folder, logs.path());
        return advice::Ran{ran.out, ran.err, ran.exit};
      });
  for (const auto& problem : problems)
    fmt::print("--help: {}\n", problem);
  return problems.empty();
}

void write_inputs(const Transcript& transcript, const fs::path& work) {
  for (const auto& input : transcript.inputs)
    files::write(work / input.name, content_of(input));
}

/// Follows the advice of each command of a transcript right after it ran.
bool follow_advice(const fs::path& path) {
  const auto text = files::read(path);
  const files::Scratch scratch;
  const files::Scratch logs;
  const auto work = settle(scratch.path());
  const advice::Run run_in = [&](const std::string& command, const fs::path& folder) {
    const auto ran = run(command, folder, logs.path());
    return advice::Ran{ran.out, ran.err, ran.exit};
  };
  bool good = true;
  const auto tell = [&](const std::string& command, const std::vector<std::string>& problems) {
    for (const auto& problem : problems)
      fmt::print("{}\n  $ {}\n    {}\n", path.string(), command, problem);
    good = good && problems.empty();
  };
  if (path.extension() == ".md") {
    tell("", advice::problems_of_page(text, run_in));
    return good;
  }
  const auto transcript = parse(text);
  write_inputs(transcript, work);
  for (const auto& step : transcript.steps)
    tell(step.command, advice::problems(step.command, run_in(step.command, work), work, run_in));
  return good;
}

bool check_transcript(const fs::path& path, const Options& options) {
  const auto expected = parse(files::read(path));
  const files::Scratch scratch;
  const files::Scratch logs;
  const auto work = settle(scratch.path());
  write_inputs(expected, work);
  if (expected.steps.empty()) {
    fmt::print("{}: holds no step; write a line `$ orb …`\n", path.string());
    return false;
  }
  auto actual = expected;
  for (auto& step : actual.steps) {
    step = run(step.command, work, logs.path());
    if (options.pseudo)
      marks_seen += without_marks(step.out) + without_marks(step.err);
  }
  return actual.steps == expected.steps || compare(path, print(expected), print(actual), options);
}

/// Runs a page of the documentation: its commands must succeed and print what the page shows.
bool check_page(const fs::path& path, const Options& options) {
  const auto text = files::read(path);
  const auto page = docs::read(text);
  const files::Scratch scratch;
  const files::Scratch logs;
  const auto work = settle(scratch.path());
  for (const auto& file : page.files)
    files::write(work / file.name, file.text);
  auto ran = docs::run(page, work.string(), logs.path().string());
  bool good = page.problems.empty();
  for (const auto& problem : page.problems)
    fmt::print("{}:{}: {}\n", path.string(), problem.line, problem.text);
  for (auto& command : ran) {
    replace_folders(command.output, work);
    if (command.shown || command.exit == 0)
      continue;
    fmt::print("{}:{}: `{}` exits with {}:\n{}", path.string(), command.line, command.text,
               command.exit, command.output);
    good = false;
  }
  return compare(path, text, docs::with_outputs(text, ran), options) && good;
}

bool check(const fs::path& path, const Options& options) {
  const bool good = options.advice              ? follow_advice(path)
                    : path.extension() == ".md" ? check_page(path, options)
                                                : check_transcript(path, options);
  shell::end_all();
  return good;
}

/// Returns the transcripts and pages in `paths`, including those in folders.
std::vector<fs::path> transcripts(const std::vector<fs::path>& paths) {
  std::vector<fs::path> files;
  for (const auto& path : paths) {
    if (!fs::is_directory(path)) {
      files.push_back(path);
      continue;
    }
    for (const auto& entry : fs::recursive_directory_iterator(path))
      if (entry.path().extension() == ".txt" || entry.path().extension() == ".md")
        files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// Every transcript runs in the same environment, whatever the developer's shell sets.
void set_environment(const Options& options) {
  const char* path = std::getenv("PATH");
  const auto with_orb = fs::absolute(options.orb).parent_path().string() + ":" + (path ? path : "");
  ::setenv("PATH", with_orb.c_str(), 1);
  ::setenv("ROOT", fs::canonical(options.root).c_str(), 1);
  ::setenv("LC_ALL", options.pseudo ? "" : "C", 1);
  ::setenv("LC_MESSAGES", options.pseudo ? "qps" : "C", 1);
  ::setenv("TERM", "dumb", 1);
  // Transcripts must not see real robots nearby.
  ::setenv("DBUS_SYSTEM_BUS_ADDRESS", "unix:path=/nonexistent/bus", 1);
  for (const char* name :
       {"ORB_PORT", "ORB_TARGET", "NO_COLOR", "CLICOLOR_FORCE", "XDG_CONFIG_HOME"})
    ::unsetenv(name);
}

} // namespace

int main(int argc, char** argv) {
  Options options;
  const std::vector<std::string> words(argv + 1, argv + argc);
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == "--update")
      options.update = true;
    else if (words[i] == "--pseudo")
      options.pseudo = true;
    else if (words[i] == "--advice")
      options.advice = true;
    else if (words[i] == "--orb" && i + 1 < words.size())
      options.orb = words[++i];
    else if (words[i] == "--root" && i + 1 < words.size())
      options.root = words[++i];
    else
      options.paths.emplace_back(words[i]);
  }
  if (options.orb.empty() || options.root.empty() || options.paths.empty()) {
    fmt::print(stderr, "usage: golden [--update|--pseudo|--advice] --orb PROGRAM --root CHECKOUT "
                       "FILE|FOLDER...\n");
    return 2;
  }
  set_environment(options);
  shell::watch_signals();
  const auto files = transcripts(options.paths);
  std::size_t failed = options.advice && !follow_help() ? 1 : 0;
  for (const auto& file : files)
    if (!shell::was_interrupted() && !check(file, options))
      ++failed;
  if (shell::was_interrupted())
    return 130;
  fmt::print("{} transcripts, {} failed\n", files.size(), failed);
  if (options.pseudo)
    fmt::print("{} texts were said in the pseudo-locale\n", marks_seen);
  if (options.advice)
    fmt::print("{} suggestions were followed\n", advice::tried());
  const bool is_said =
      (!options.pseudo || marks_seen > 0) && (!options.advice || advice::tried() > 0);
  return failed == 0 && !files.empty() && is_said ? 0 : 1;
}
