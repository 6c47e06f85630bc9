#include "tests/docs/page.h"

#include "tests/golden/files.h"
#include "tests/golden/shell.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fmt/format.h>
#include <utility>

namespace docs {
namespace {

constexpr std::string_view fence_mark = "```";

/// A fence; a `<!-- run: … -->` counts as a fence with a single command.
struct Block {
  std::string word;      ///< the language named by the fence
  std::string name;      ///< the file's name, if it is a file
  bool skipped = false;  ///< `<!-- not run: REASON -->`
  std::size_t begin = 0; ///< index of its first line
  std::vector<std::string> lines;
};

/// The file name of a listing, and the command that must find no error in it.
struct Language {
  std::string_view word;
  std::string_view check;
};
constexpr auto languages = std::to_array<Language>(
    {{"basic", "orb check"},
     {"orb", "orb check"},
     {"macro", "orb check"},
     {"test", "orb check"},
     {"stimulus", "orb run -q \"$ROOT\"/examples/demo/square.bas --for 1s --stimulus"}});
constexpr auto quiet_words = std::to_array<std::string_view>(
    {"text", "json", "toml", "svg", "cpp", "cmake", "python", "lua", "yaml"});

/// Returns the text between `<!-- KEY: ` and ` -->`; empty for other lines.
std::string comment(std::string_view line, std::string_view key) {
  const auto head = fmt::format("<!-- {}: ", key);
  constexpr std::string_view tail = " -->";
  if (!line.starts_with(head) || !line.ends_with(tail) || line.size() <= head.size() + tail.size())
    return {};
  return std::string(line.substr(head.size(), line.size() - head.size() - tail.size()));
}

std::vector<Block> blocks(const std::vector<std::string>& lines, std::vector<Problem>& problems) {
  std::vector<Block> found;
  Block next;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const auto& line = lines[i];
    if (const auto command = comment(line, "run"); !command.empty()) {
      found.push_back({"run", {}, false, i, {command}});
    } else if (const auto name = comment(line, "file"); !name.empty()) {
      next.name = name;
    } else if (!comment(line, "not run").empty()) {
      next.skipped = true;
    } else if (line.starts_with(fence_mark)) {
      next.word = line.substr(fence_mark.size());
      next.begin = i + 1;
      while (++i < lines.size() && lines[i] != fence_mark)
        next.lines.push_back(lines[i]);
      found.push_back(std::exchange(next, {}));
    } else {
      if (line.starts_with("    orb ") || line.find(fence_mark) != std::string::npos)
        problems.push_back({i + 1, "put commands into a fence at the margin: ```sh"});
      next = {};
    }
  }
  return found;
}

/// Adds the commands of a fence: every line of `sh`, every `$ ` line of `console`.
void add_commands(const Block& block, std::vector<Command>& commands) {
  const bool shown = block.word == "console";
  bool goes_on = false;
  for (std::size_t i = 0; i < block.lines.size(); ++i) {
    const auto& line = block.lines[i];
    const bool begins = !shown || line.starts_with("$ ");
    if (goes_on)
      commands.back().text += "\n" + line;
    else if (begins && !line.empty())
      commands.push_back({block.begin + i + 1, shown ? line.substr(2) : line, shown, {}, 0});
    else if (shown && !commands.empty())
      commands.back().output += line + "\n";
    goes_on = (goes_on || begins) && line.ends_with('\\');
  }
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const auto& line : lines)
    text += line + "\n";
  return text;
}

void add(const Block& block, Page& page) {
  const auto language = std::find_if(languages.begin(), languages.end(),
                                     [&](const auto& row) { return row.word == block.word; });
  const bool listing = language != languages.end();
  auto name = block.name;
  if (name.empty() && listing)
    name = fmt::format("listing-{}.{}", block.begin, block.word == "basic" ? "bas" : block.word);
  if (!name.empty())
    page.files.push_back({name, joined(block.lines)});
  if (block.skipped)
    return;
  if (block.word == "sh" || block.word == "console" || block.word == "run")
    add_commands(block, page.commands);
  else if (listing)
    page.commands.push_back(
        {block.begin, fmt::format("{} {}", language->check, name), false, {}, 0});
  else if (std::find(quiet_words.begin(), quiet_words.end(), block.word) == quiet_words.end())
    page.problems.push_back(
        {block.begin, fmt::format("say after ``` what the fence holds: sh, console, basic, orb, "
                                  "macro, stimulus, test, json, toml or text (found `{}`)",
                                  block.word)});
}

std::string step_file(const std::string& logs, std::size_t step, std::string_view kind) {
  return fmt::format("{}/{}.{}", logs, step, kind);
}

} // namespace

Page read(std::string_view text) {
  Page page;
  for (const auto& block : blocks(files::lines(text), page.problems))
    add(block, page);
  return page;
}

std::string with_outputs(std::string_view text, const std::vector<Command>& ran) {
  const auto lines = files::lines(text);
  std::vector<Problem> ignored;
  std::string page;
  std::size_t copied = 0;
  for (const auto& block : blocks(lines, ignored)) {
    if (block.word != "console" || block.skipped)
      continue;
    page += joined({lines.begin() + static_cast<std::ptrdiff_t>(copied),
                    lines.begin() + static_cast<std::ptrdiff_t>(block.begin)});
    copied = block.begin + block.lines.size();
    for (const auto& command : ran)
      if (command.shown && command.line > block.begin && command.line <= copied)
        page += "$ " + command.text + "\n" + command.output;
  }
  return page + joined({lines.begin() + static_cast<std::ptrdiff_t>(copied), lines.end()});
}

std::vector<Command> run(const Page& page, const std::string& folder, const std::string& logs) {
  // Waits for the first output of a background command, as a reader would. Stops what still runs at
  // the end of the page and waits for it: it removes files of its own from the folder, which is
  // removed next.
  auto script = fmt::format(
      "cd '{}' && exec </dev/null\ntrap 'kill $(jobs -p) 2>/dev/null; wait' EXIT\n", folder);
  for (std::size_t i = 0; i < page.commands.size(); ++i) {
    const auto out = step_file(logs, i, "out");
    files::write(step_file(logs, i, "command"), page.commands[i].text + "\n");
    script += fmt::format("eval \"$(cat '{}')\" >'{}' 2>&1\necho $? >'{}'\n",
                          step_file(logs, i, "command"), out, step_file(logs, i, "exit"));
    if (page.commands[i].text.ends_with('&'))
      script +=
          fmt::format("for i in {{1..1000}}; do [ -s '{}' ] && break; sleep 0.01; done\n", out);
  }
  files::write(logs + "/script", script);
  shell::run(fmt::format("exec bash '{}/script'", logs));
  auto ran = page.commands;
  for (std::size_t i = 0; i < ran.size(); ++i) {
    const auto exit = files::read(step_file(logs, i, "exit"));
    ran[i].output = files::read(step_file(logs, i, "out"));
    ran[i].exit = exit.empty() ? -1 : std::atoi(exit.c_str());
  }
  return ran;
}

} // namespace docs
