// mutants ROOT [--mutants N] [--show | --faults N]: changes a token of the examples and lessons, in
// all four languages, and applies the safe fixes, as `orb check --fix` does. Fails if a fix adds
// errors, if a second --fix changes something, if a fix changes the meaning of a program that ran,
// or if a fix makes a program run that neither equals the original nor keeps all numbers, names and
// texts of the mutant.
//
// With --faults it applies no fixes, but runs mutants of clean programs until a fault has stopped N
// of them, and counts those in which `orb check` finds nothing.

#include "base/fixes.h"
#include "mutants/faults.h"
#include "repair/safety.h"
#include "slips/judge.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <iostream>
#include <iterator>
#include <random>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
using slips::Language;
using slips::Lines;

constexpr std::array languages = {orb::repair::Language::Basic, orb::repair::Language::Structured,
                                  orb::repair::Language::Macro, orb::repair::Language::Test};

struct Program {
  std::string name;
  Language language = Language::Basic;
  Lines lines;
  std::string meaning;
};

std::vector<Program> programs(const fs::path& root) {
  std::vector<fs::path> paths;
  for (const auto& entry : fs::recursive_directory_iterator(root / "examples"))
    if (entry.is_regular_file())
      paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  std::vector<Program> all;
  for (const auto& path : paths) {
    const auto* const ending =
        std::find_if(std::begin(slips::endings), std::end(slips::endings),
                     [&](std::string_view e) { return path.extension() == "." + std::string(e); });
    if (ending == std::end(slips::endings))
      continue;
    std::ifstream in(path, std::ios::binary);
    Program one;
    one.name = path.filename().string();
    one.language = static_cast<Language>(ending - std::begin(slips::endings));
    one.lines = slips::split({std::istreambuf_iterator<char>(in), {}});
    one.meaning = slips::meaning(one.language, one.lines);
    if (!one.meaning.empty()) // empty for programs that include others
      all.push_back(std::move(one));
  }
  return all;
}

// ---- tokens, as they stand in a line

struct Piece {
  std::size_t begin;
  std::size_t end;
};

bool is_part(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

/// True if a decimal point and digits follow.
bool is_point(const std::string& line, std::size_t at) {
  return line[at] == '.' && at + 1 < line.size() &&
         std::isdigit(static_cast<unsigned char>(line[at + 1])) != 0;
}

/// The tokens of a line up to its remark.
std::vector<Piece> pieces_of(Language language, const std::string& line) {
  const std::string_view remark =
      language == Language::Basic || language == Language::Structured ? "'" : "#;";
  std::vector<Piece> all;
  for (std::size_t at = 0; at < line.size();) {
    auto end = at + 1;
    if (line[at] == ' ') {
      at = end;
      continue;
    }
    const bool colour = line[at] == '#' && end < line.size() && is_part(line[end]);
    if (remark.find(line[at]) != std::string_view::npos && !colour)
      break;
    if (line[at] == '"')
      end = std::min(line.find('"', end), line.size() - 1) + 1;
    else if (is_part(line[at]) || colour || is_point(line, at))
      while (end < line.size() && (is_part(line[end]) || is_point(line, end)))
        ++end;
    all.push_back({at, end});
    at = end;
  }
  return all;
}

/// Returns the line with a token omitted, doubled, swapped, replaced, joined to the next, or split.
std::string mutated(const Program& program, std::size_t at, std::mt19937& random) {
  const auto& line = program.lines[at];
  const auto pieces = pieces_of(program.language, line);
  if (pieces.empty())
    return line;
  const auto pick = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  const auto n = pick(pieces.size());
  const auto [begin, end] = pieces[n];
  const auto token = line.substr(begin, end - begin);
  const bool last = n + 1 == pieces.size();
  auto changed = line;
  switch (pick(6)) {
  case 0: changed.erase(begin, end - begin); break;
  case 1: changed.insert(end, " " + token); break;
  case 2:
    if (!last) {
      const auto& next = pieces[n + 1];
      changed = line.substr(0, begin) + line.substr(next.begin, next.end - next.begin) +
                line.substr(end, next.begin - end) + token + line.substr(next.end);
    }
    break;
  case 3: {
    const auto& other = program.lines[pick(program.lines.size())];
    const auto others = pieces_of(program.language, other);
    if (!others.empty()) {
      const auto& from = others[pick(others.size())];
      changed.replace(begin, end - begin, other.substr(from.begin, from.end - from.begin));
    }
    break;
  }
  case 4:
    if (!last)
      changed.erase(end, pieces[n + 1].begin - end);
    break;
  default:
    if (end - begin > 1)
      changed.insert(begin + 1 + pick(end - begin - 1), " ");
  }
  return changed;
}

// ---- what a program says

/// Normalises a number with its unit to milliseconds: `.5s` is `500ms`.
std::string as_written(const std::string& token) {
  char* unit = nullptr;
  const auto value = std::strtod(token.c_str(), &unit);
  return fmt::format("{}", std::string_view(unit) == "s" ? value * 1000 : value);
}

/// Normalises two spellings of the same: `0 - 1` is orbBasic's `-1`, and a leading `;` in a `print`
/// has no effect.
std::string plain(std::string meaning) {
  meaning = std::regex_replace(meaning, std::regex("\\(0-([A-Z0-9]+)\\)"), "-$1");
  meaning = std::regex_replace(meaning, std::regex("\\b0-"), "-");
  return std::regex_replace(meaning, std::regex("(print|\\?)[ ;]*"), "print");
}

/// Returns the numbers (except line numbers), texts and names of a program.
std::multiset<std::string> values_of(Language language, const Lines& lines,
                                     const std::vector<std::string>& names) {
  std::multiset<std::string> all;
  for (const auto& line : lines) {
    const auto pieces = pieces_of(language, line);
    for (std::size_t n = 0; n < pieces.size(); ++n) {
      const auto token = line.substr(pieces[n].begin, pieces[n].end - pieces[n].begin);
      const bool number = std::isdigit(static_cast<unsigned char>(token[0])) != 0 ||
                          (token[0] == '.' && token.size() > 1);
      const bool letter = language == Language::Basic && token.size() == 1 &&
                          std::isupper(static_cast<unsigned char>(token[0])) != 0;
      if (token[0] == '"' || (number && (n > 0 || language != Language::Basic)) || letter ||
          std::find(names.begin(), names.end(), token) != names.end())
        all.insert(number ? as_written(token) : token);
    }
  }
  return all;
}

struct Counts {
  std::size_t mutants = 0;
  std::size_t ran = 0;      ///< that run, too
  std::size_t fixed = 0;    ///< of the others, changed by --fix
  std::size_t builds = 0;   ///< of these, run afterwards
  std::size_t restored = 0; ///< equal to the original
  std::size_t kept = 0;     ///< different, with all values of the mutant
  std::size_t wrong = 0;    ///< violations
};

class Judge {
public:
  explicit Judge(bool show) : show_(show) {}

  void judge(const Program& program, std::size_t at, const std::string& changed) {
    auto& count = counts_[static_cast<std::size_t>(program.language)];
    ++count.mutants;
    auto mutant = program.lines;
    mutant[at] = changed;
    const auto text = slips::join(mutant);
    const auto check = [&](std::string_view of) {
      return slips::findings(program.language, std::string(of));
    };
    const auto errors = [&](const std::string& of) {
      const auto found = check(of);
      return std::count_if(found.begin(), found.end(), orb::keeps_from_building);
    };
    const auto before = errors(text);
    const auto fixed = orb::fix_all(text, check);
    const auto lines = slips::split(fixed.text);
    const auto fail = [&](const char* why) {
      ++count.wrong;
      std::cerr << fmt::format("{}: {}:{}\n  meant   {}\n  mutant  {}\n", why, program.name, at + 1,
                               program.lines[at], changed);
      for (const auto& line : lines)
        if (std::find(mutant.begin(), mutant.end(), line) == mutant.end())
          std::cerr << "  fixed   " << line << '\n';
    };
    if (errors(fixed.text) > before)
      fail("more errors");
    else if (fixed.count > 0 && orb::fix_all(fixed.text, check).count > 0)
      fail("not at rest");
    if (const auto ran = slips::meaning(program.language, mutant); !ran.empty()) {
      ++count.ran;
      if (fixed.count > 0 && plain(slips::meaning(program.language, lines)) != plain(ran))
        fail("another program");
      return;
    }
    if (fixed.text == text)
      return;
    ++count.fixed;
    const auto meaning = slips::meaning(program.language, lines);
    count.builds += meaning.empty() ? 0 : 1;
    if (meaning == program.meaning) {
      ++count.restored;
      return;
    }
    const orb::Source source({}, slips::join(program.lines));
    const auto names =
        orb::repair::defined_names(source, languages[static_cast<std::size_t>(program.language)]);
    if (values_of(program.language, mutant, names) != values_of(program.language, lines, names)) {
      fail("other values");
    } else if (!meaning.empty()) {
      ++count.kept;
      if (show_)
        fail("kept");
    }
  }

  /// Prints the table; returns false if a rule was violated.
  bool report() const {
    std::cout << "| language | mutants | run | fixed | build then | as meant | keep their values | "
                 "wrong |\n"
                 "|---|--:|--:|--:|--:|--:|--:|--:|\n";
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < counts_.size(); ++i) {
      const auto& c = counts_[i];
      std::cout << fmt::format("| `.{}` | {} | {} | {} | {} | {} | {} | {} |\n", slips::endings[i],
                               c.mutants, c.ran, c.fixed, c.builds, c.restored, c.kept, c.wrong);
      wrong += c.wrong;
    }
    return wrong == 0;
  }

private:
  std::array<Counts, 4> counts_{};
  bool show_;
};

/// Runs mutants of clean programs until a fault has stopped the given number.
void count_faults(std::vector<Program> all, std::size_t faults) {
  std::erase_if(all, [](const Program& one) {
    return (one.language != Language::Basic && one.language != Language::Structured) ||
           !slips::findings(one.language, slips::join(one.lines)).empty();
  });
  std::mt19937 random(63);
  mutants::Faults count;
  while (count.count() < faults) {
    const auto& program = all[random() % all.size()];
    const auto at = static_cast<std::size_t>(random() % program.lines.size());
    auto mutant = program.lines;
    mutant[at] = mutated(program, at, random);
    if (mutant[at] != program.lines[at])
      count.judge(program.name, program.language, mutant, at);
  }
  count.report();
}

} // namespace

int main(int argc, char** argv) {
  if (argc < 2)
    return 2;
  std::size_t most = 400;
  std::size_t faults = 0;
  bool show = false;
  for (int i = 2; i < argc; ++i) {
    const std::string_view option = argv[i];
    show = show || option == "--show";
    if (option == "--mutants" && i + 1 < argc)
      most = std::strtoul(argv[++i], nullptr, 10);
    if (option == "--faults" && i + 1 < argc)
      faults = std::strtoul(argv[++i], nullptr, 10);
  }
  const auto all = programs(argv[1]);
  if (faults > 0) {
    count_faults(all, faults);
    return 0;
  }
  std::mt19937 random(63);
  Judge judge(show);
  for (std::size_t n = 0; n < most;) { // one language after the other
    const auto& program = all[random() % all.size()];
    if (program.language != static_cast<Language>(n % 4))
      continue;
    const auto at = static_cast<std::size_t>(random() % program.lines.size());
    const auto changed = mutated(program, at, random);
    if (changed == program.lines[at])
      continue;
    judge.judge(program, at, changed);
    ++n;
  }
  return judge.report() ? 0 : 1;
}
