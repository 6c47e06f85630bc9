#include "tests/golden/advice.h"

#include "tests/golden/files.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <regex>
#include <set>

namespace fs = std::filesystem;

namespace advice {
namespace {

std::size_t count = 0;

constexpr std::size_t longest = 400; // per line of output

/// Returns the lines meant for people, without data.
std::vector<std::string> lines_for_people(const std::string& output) {
  auto lines = files::lines(output);
  std::erase_if(lines, [](const std::string& line) { return line.size() > longest; });
  return lines;
}

/// A finding in the text output of `orb check`.
struct Finding {
  std::string file;
  std::size_t line = 0;
  std::size_t column = 0;
  std::size_t width = 0; ///< of the marked text
  std::string severity;
  std::string rule;
  std::string message;
  std::string help;
};

std::vector<Finding> findings_in(const std::string& output) {
  static const std::regex head(
      R"(^([^\s:][^:]*):(\d+):(\d+): (error|warning|info)\[([\w-]+)\]: (.*)$)");
  static const std::regex note(R"(^\S+:\d+:\d+: note.*)");
  static const std::regex mark(R"(^ *\| *(\^~*).*$)");
  constexpr std::string_view help = "  help: ";
  std::vector<Finding> all;
  bool within = false;
  for (const auto& line : lines_for_people(output)) {
    std::smatch found;
    if (std::regex_match(line, found, head)) {
      all.push_back({found[1],
                     std::stoul(found[2]),
                     std::stoul(found[3]),
                     0,
                     found[4],
                     found[5],
                     found[6],
                     {}});
      within = true;
    } else if (std::regex_match(line, note)) {
      within = false; // the mark there belongs to another place
    } else if (within && all.back().width == 0 && std::regex_match(line, found, mark)) {
      all.back().width = static_cast<std::size_t>(found[1].length());
    } else if (within && all.back().help.empty() && line.starts_with(help)) {
      all.back().help = line.substr(help.size());
    }
  }
  return all;
}

/// Returns the texts between backticks on one line.
std::vector<std::string> quoted(const std::string& text) {
  std::vector<std::string> all;
  for (const auto& line : files::lines(text))
    for (auto begin = line.find('`'); begin != std::string::npos;) {
      const auto end = line.find('`', begin + 1);
      if (end == std::string::npos)
        break;
      all.push_back(line.substr(begin + 1, end - begin - 1));
      begin = line.find('`', end + 1);
    }
  return all;
}

/// `orb check --fix` names a command and an option; `orb FILE` and `orb …` cannot be tried.
std::optional<std::string> wrong_command(const std::string& text, const Run& run) {
  static std::map<std::string, Ran> helps;
  std::vector<std::string> words;
  for (auto rest = text; !rest.empty();) {
    const auto end = std::min(rest.find(' '), rest.size());
    words.push_back(rest.substr(0, end));
    rest.erase(0, std::min(end + 1, rest.size()));
  }
  static const std::regex is_command("[a-z_]+");
  if (words.size() < 2 || words[0] != "orb" || !std::regex_match(words[1], is_command))
    return std::nullopt;
  ++count;
  const auto known = helps.find(words[1]);
  const auto& help =
      known != helps.end()
          ? known->second
          : helps.emplace(words[1], run("orb " + words[1] + " --help", "/")).first->second;
  if (help.exit != 0)
    return fmt::format("`{}`: there is no command `{}`", text, words[1]);
  if (words[1] == "spec" && words.size() > 2 && words[2][0] != '-' && words[2] != "SECTION" &&
      run("orb spec " + words[2], "/").exit != 0)
    return fmt::format("`{}`: there is no such section", text);
  static const std::regex option("--[a-z0-9-]+");
  for (const auto& word : words) {
    std::smatch found;
    if (std::regex_search(word, found, option, std::regex_constants::match_continuous) &&
        found.str() != "--help" && help.out.find(found.str()) == std::string::npos)
      return fmt::format("`{}`: `orb {}` has no option `{}`", text, words[1], found.str());
  }
  return std::nullopt;
}

/// True if a command only calls orb, so that it can be run again with something added.
bool is_simple(const std::string& command) {
  return command.starts_with("orb ") && command.find_first_of("|;&<>$*") == std::string::npos;
}

fs::path copy_of(const fs::path& work, const files::Scratch& scratch) {
  const auto copy = scratch.path() / "work";
  fs::copy(work, copy, fs::copy_options::recursive | fs::copy_options::copy_symlinks);
  return copy;
}

/// ``add `--input 20` ``: with it, the command must not repeat its advice.
void try_options(const std::string& command, const Ran& ran, const fs::path& work, const Run& run,
                 std::vector<std::string>& wrong) {
  static const std::regex advice("^.*\\b(?:add|give|answer it with) `(--[^`]*)`.*$");
  static const std::regex hole("[A-Z]{3}|…|\\{");
  for (const auto& line : lines_for_people(ran.out + ran.err)) {
    std::smatch found;
    if (!std::regex_match(line, found, advice) || std::regex_search(found[1].str(), hole))
      continue;
    ++count;
    const files::Scratch scratch;
    const auto again = run(command + " " + found[1].str(), copy_of(work, scratch));
    if (again.exit == 2 || (again.out + again.err).find(line) != std::string::npos)
      wrong.push_back(fmt::format("{}\n    with it: {}{}", line, again.out, again.err));
  }
}

/// Returns the lines that a help offers: alternatives of one line or more.
struct Offer {
  std::size_t line;
  std::vector<std::vector<std::string>> choices;
};

std::optional<Offer> offer_of(const Finding& finding) {
  static const std::regex write("^write ((?:`[^`]*`(?:, then | or |))+)(.*)$");
  static const std::regex elsewhere("^ on line (\\d+).*$");
  std::smatch found;
  if (!std::regex_match(finding.help, found, write))
    return std::nullopt;
  Offer offer{finding.line, {}};
  const std::string rest = found[2];
  std::smatch there;
  if (std::regex_match(rest, there, elsewhere))
    offer.line = std::stoul(there[1]);
  else if (!rest.empty() && rest[0] != ';' && rest[0] != ',')
    return std::nullopt; // ``write `X` in the loop``
  std::string choices = found[1];
  constexpr std::string_view other = "` or `";
  for (auto end = choices.find(other); !choices.empty(); end = choices.find(other)) {
    const bool last = end == std::string::npos;
    offer.choices.push_back(quoted(last ? choices : choices.substr(0, end + 1)));
    choices.erase(0, last ? choices.size() : end + other.size() - 1);
  }
  return offer;
}

/// How an offer changes its line.
enum class Place { Marked, Word, Line };

std::string number_of(const std::string& line) {
  static const std::regex number("^\\s*\\d+\\s+");
  std::smatch found;
  return std::regex_search(line, found, number) ? found.str() : std::string();
}

/// Returns the text with the offered line in place of the line with the same number, and without
/// the lines that the help removes; nothing if the offer is for the finding's own line.
std::optional<std::string> joined(const std::string& text, const Finding& finding,
                                  const std::string& offered) {
  static const std::regex range("remove lines (\\d+) to (\\d+)");
  static const std::regex single("remove line (\\d+)");
  const auto lines = files::lines(text);
  const auto number = number_of(offered);
  if (number.empty() || number_of(lines[finding.line - 1]) == number)
    return std::nullopt;
  unsigned long first = 0;
  unsigned long last = 0;
  std::smatch found;
  if (std::regex_search(finding.help, found, range)) {
    first = std::stoul(found[1]);
    last = std::stoul(found[2]);
  } else if (std::regex_search(finding.help, found, single)) {
    first = last = std::stoul(found[1]);
  } else if (finding.help.find("remove this line") != std::string::npos) {
    first = last = std::stoul("0" + number_of(lines[finding.line - 1]));
  }
  std::string all;
  for (const auto& line : lines) {
    const auto own = number_of(line);
    const auto value = own.empty() ? 0 : std::stoul(own);
    if (value == 0 || value < first || value > last)
      all += (own == number ? offered : line) + "\n";
  }
  return all;
}

/// Returns the text with an offer inserted; nothing if it does not fit there.
std::optional<std::string> with_offer(const std::string& text, const Finding& finding,
                                      std::size_t line, const std::vector<std::string>& offered,
                                      Place place) {
  auto lines = files::lines(text);
  if (line == 0 || line > lines.size() || offered.empty())
    return std::nullopt;
  auto& old = lines[line - 1];
  std::string written;
  if (place != Place::Line) {
    if (offered.size() > 1 || line != finding.line || finding.column == 0 ||
        finding.column - 1 > old.size())
      return std::nullopt;
    auto begin = finding.column - 1;
    auto end = std::min(begin + finding.width, old.size());
    if (place == Place::Word) { // `id=20` where only the number is marked
      begin = old.find_last_of(' ', begin) + 1;
      end = std::min(old.find(' ', end), old.size());
    }
    const auto is_of_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; };
    const bool glued = begin > 0 && is_of_word(old[begin - 1]) && is_of_word(offered[0].front());
    written = old;
    written.replace(begin, end - begin, (glued ? " " : "") + offered[0]);
  } else {
    const auto indent = old.substr(0, std::min(old.find_first_not_of(" \t"), old.size()));
    const auto number = number_of(old);
    for (std::size_t i = 0; i < offered.size(); ++i) {
      const bool numbered = !number_of(offered[i]).empty();
      written += i == 0 ? "" : "\n";
      written += numbered         ? ""
                 : number.empty() ? indent
                 : i == 0         ? number
                                  : fmt::format("{} ", std::stoul(number) + i);
      written += offered[i];
    }
  }
  old = written;
  std::string all;
  for (const auto& one : lines)
    all += one + "\n";
  return all;
}

/// True if the offered lines have neither the same finding nor a new error.
bool is_good(const std::vector<Finding>& before, const std::vector<Finding>& after,
             const Finding& finding, std::size_t line, std::size_t lines) {
  const auto errors = [&](const std::vector<Finding>& all, std::size_t last) {
    return std::count_if(all.begin(), all.end(), [&](const Finding& one) {
      return one.file == finding.file && one.line >= line && one.line <= last &&
             one.severity == "error" && one.rule != "block-end" && one.rule != "unclosed-block";
    });
  }; // the other end of a block has an offer of its own
  const bool again = std::any_of(after.begin(), after.end(), [&](const Finding& one) {
    return one.file == finding.file && one.line >= line && one.line < line + lines &&
           one.rule == finding.rule && one.message == finding.message;
  });
  const auto mended = finding.severity == "error" && finding.line == line ? 1 : 0;
  return !again && errors(after, line + lines - 1) <= std::max(errors(before, line) - mended, 0L);
}

void try_line(const std::string& command, const std::vector<Finding>& all, const Finding& finding,
              const fs::path& work, const Run& run, std::vector<std::string>& wrong) {
  const auto offer = offer_of(finding);
  if (!offer || !fs::is_regular_file(work / finding.file))
    return;
  const auto text = files::read(work / finding.file);
  for (const auto& choice : offer->choices) {
    ++count;
    bool good = false;
    if (const auto text_joined = joined(text, finding, choice[0])) {
      const files::Scratch scratch;
      const auto folder = copy_of(work, scratch);
      files::write(folder / finding.file, *text_joined);
      const auto after = findings_in(run(command, folder).out);
      good = std::none_of(after.begin(), after.end(), [&](const Finding& one) {
        return one.rule == finding.rule && one.message == finding.message;
      });
    }
    // A whole line usually replaces the line: try that first.
    const bool is_line = choice[0].find(' ') != std::string::npos;
    for (const auto place : is_line ? std::array{Place::Line, Place::Marked, Place::Word}
                                    : std::array{Place::Marked, Place::Word, Place::Line}) {
      const auto changed = with_offer(text, finding, offer->line, choice, place);
      if (good || !changed)
        continue;
      const files::Scratch scratch;
      const auto folder = copy_of(work, scratch);
      files::write(folder / finding.file, *changed);
      const auto after = findings_in(run(command, folder).out);
      good = is_good(all, after, finding, offer->line, choice.size());
    }
    if (!good)
      wrong.push_back(fmt::format("{}:{}:{}: [{}] {}\n    help: {}", finding.file, finding.line,
                                  finding.column, finding.rule, finding.message, finding.help));
  }
}

void try_commands(const std::string& text, const Run& run, std::vector<std::string>& wrong) {
  std::set<std::string> seen;
  for (const auto& one : quoted(text))
    if (one.starts_with("orb ") && seen.insert(one).second)
      if (auto problem = wrong_command(one, run))
        wrong.push_back(*std::move(problem));
}

} // namespace

std::vector<std::string> problems(const std::string& command, const Ran& ran, const fs::path& work,
                                  const Run& run) {
  std::vector<std::string> wrong;
  try_commands(ran.out + ran.err, run, wrong);
  if (!is_simple(command))
    return wrong;
  try_options(command, ran, work, run, wrong);
  if (command.find(" --fix") == std::string::npos) {
    const auto all = findings_in(ran.out);
    for (const auto& finding : all)
      try_line(command, all, finding, work, run, wrong);
  }
  return wrong;
}

std::vector<std::string> problems_of_page(const std::string& text, const Run& run) {
  std::vector<std::string> wrong;
  try_commands(text, run, wrong);
  return wrong;
}

std::vector<std::string> problems_of_help(const Run& run) {
  static const std::regex entry("^  ([a-z]+)  +.*$");
  std::vector<std::string> wrong;
  for (const auto& line : files::lines(run("orb --help", "/").out)) {
    std::smatch found;
    if (!std::regex_match(line, found, entry))
      continue;
    const auto help = run("orb " + found[1].str() + " --help", "/").out;
    try_commands(help, run, wrong);
    for (const auto& example : files::lines(help)) {
      const auto begin = example.find_first_not_of(' ');
      if (begin == std::string::npos || !example.substr(begin).starts_with("orb "))
        continue;
      const auto end = example.find('|', begin);
      if (auto problem = wrong_command(example.substr(begin, end - begin), run))
        wrong.push_back(*std::move(problem));
    }
  }
  return wrong;
}

std::size_t tried() {
  return count;
}

} // namespace advice
