// slips ROOT [--update]: plants beginners' slips into every program of ROOT/examples, one at a
// time, and counts how many are explained on their line with the right words, and how many `--fix`
// takes back. Prints docs/slips.md; fails when that page says something else, when too few are
// explained or fixed, or when a fix leaves more errors or others than there were.

#include "compiler/check.h"
#include "compiler/text/parse.h"
#include "compiler/text/print.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <functional>
#include <iostream>
#include <iterator>
#include <optional>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
using orb::Severity;
using Lines = std::vector<std::string>;

/// Changes line `i` of a program, or others with it; false where the slip cannot stand there.
using Plant = std::function<bool(Lines&, std::size_t)>;

struct Slip {
  std::string example; ///< as it looks in a program
  Plant plant;
  std::string expected; ///< what the message or its help says
};

/// A slip of one line: a regular expression and what takes its place.
Plant swap(const std::string& from, const std::string& to) {
  return [from = std::regex(from), to](Lines& lines, std::size_t i) {
    const auto changed =
        std::regex_replace(lines[i], from, to, std::regex_constants::format_first_only);
    const bool done = changed != lines[i];
    lines[i] = changed;
    return done;
  };
}

Plant long_name(const std::string& name) {
  return [name](Lines& lines, std::size_t i) {
    std::smatch found;
    static const std::regex sets("^\\d+ ([A-X]) = ");
    if (!std::regex_search(lines[i], found, sets))
      return false;
    const std::regex letter("\\b" + found[1].str() + "\\b(?=[^\"]*(\"[^\"]*\"[^\"]*)*$)");
    const auto place = i;
    for (std::size_t n = 0; n < lines.size(); ++n) {
      const auto comment = lines[n].find('\'');
      lines[n] = std::regex_replace(lines[n].substr(0, comment), letter, name) +
                 (comment == std::string::npos ? "" : lines[n].substr(comment));
      if (n < place && lines[n].find(name) != std::string::npos)
        return false; // the first line that holds the name is the one to speak of
    }
    return true;
  };
}

Plant unnumbered_file() {
  return [](Lines& lines, std::size_t i) {
    static const std::regex number("^\\d+ +");
    static const std::regex target("goto|gosub");
    const auto first = std::find_if(lines.begin(), lines.end(), [](const std::string& line) {
      return std::regex_search(line, number);
    });
    if (first - lines.begin() != static_cast<std::ptrdiff_t>(i) ||
        std::any_of(lines.begin(), lines.end(),
                    [](const std::string& line) { return std::regex_search(line, target); }))
      return false;
    for (auto& line : lines)
      line = std::regex_replace(line, number, "");
    return true;
  };
}

/// Two lines on one, separated by a colon.
Plant colon() {
  return [](Lines& lines, std::size_t i) {
    static const std::regex plain("^\\d+ (?!if)[^']*[^;' ]$");
    std::smatch next;
    static const std::regex body("^(\\d+) (.*)$");
    if (i + 1 == lines.size() || !std::regex_match(lines[i], plain) ||
        !std::regex_match(lines[i + 1], next, body))
      return false;
    const std::regex named("\\b" + next[1].str() + "\\b");
    for (const auto& line : lines)
      if (line.find("go") != std::string::npos && std::regex_search(line, named))
        return false; // something jumps to the second line, or may
    lines[i] += ": " + next[2].str();
    lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(i) + 1);
    return true;
  };
}

Plant insert_below(const std::string& statement) {
  return [statement](Lines& lines, std::size_t i) {
    static const std::regex number("^(\\d+) if ");
    std::smatch found;
    if (!std::regex_search(lines[i], found, number))
      return false;
    lines[i] = fmt::format("{} {}", found[1].str(), statement);
    return true;
  };
}

// clang-format off
const std::vector<Slip> slips{
  {"rgb 255,0,0",             swap("\\bRGB\\b", "rgb"),                           "`RGB`"},
  {"GOROLL 0,100,1",          swap("\\bgoroll\\b", "GOROLL"),                     "`goroll`"},
  {"Print \"hi\"",            swap("\\bprint\\b", "Print"),                       "`print`"},
  {"backled 255",             swap("\\bbackLED\\b", "backled"),                   "`backLED`"},
  {"A = Speed",               swap("\\bspeed\\b", "Speed"),                       "`speed`"},
  {"dealy 500",               swap("\\bdelay\\b", "dealy"),                       "`delay`"},
  {"prnt \"hi\"",             swap("\\bprint\\b", "prnt"),                        "`print`"},
  {"wait 500",                swap("\\bdelay\\b", "wait"),                        "`delay"},
  {"pause 500",               swap("\\bdelay\\b", "pause"),                       "`delay"},
  {"sleep 500",               swap("\\bdelay (?=\\d+$)", "sleep "),               "`delay"},
  {"delay 1.5",               swap("\\bdelay (\\d)500\\b", "delay $1.5"),         "`delay"},
  {"delay 500ms",             swap("\\bdelay (\\d+)$", "delay $1ms"),             "`delay"},
  {"stop",                    swap("^(\\d+) end\\b", "$1 stop"),                  "`end`"},
  {"exit",                    swap("^(\\d+) end\\b", "$1 exit"),                  "`end`"},
  {"printf \"hi\"",           swap("\\bprint\\b", "printf"),                      "`print"},
  {"say \"hi\"",              swap("\\bprint\\b", "say"),                         "`print"},
  {"print 'hi'",              swap("^(\\d+ print) \"([^\"']*)\"$", "$1 '$2'"),    "`print \""},
  {"print \"hi",              swap("^(\\d+ print \"[^\"']*)\"$", "$1"),           "closing"},
  {"print \xE2\x80\x9Chi\xE2\x80\x9D", swap("^(\\d+ print) \"([^\"']*)\"", "$1 \xE2\x80\x9C$2\xE2\x80\x9D"), "straight"},
  {"print hello",             swap("^(\\d+ print) \"([A-Za-z]{3,}) ?\"", "$1 $2"), "quotes"},
  {"print \"A is \"; A",      swap("^(\\d+ print \"[^\"]*\") (?=[A-Z])", "$1; "), "space"},
  {"print \"A is \" + A",     swap("^(\\d+ print \"[^\"]*\") (?=[A-Z])", "$1 + "), "side by side"},
  {"if A == 5 then",          swap("^(\\d+ if [^\"]*?) = ", "$1 == "),            "`=`"},
  {"if A != 5 then",          swap(" ! ", " != "),                                "`!`"},
  {"if A <> 5 then",          swap(" ! ", " <> "),                                "`!`"},
  {"if A && B then",          swap(" and ", " && "),                              "`and`"},
  {"if A || B then",          swap(" or ", " || "),                               "`or`"},
  {"if A = 5 goto 60",        swap(" then goto ", " goto "),                      "`then"},
  {"if A = 5 then 60",        swap(" then goto ", " then "),                      "`goto"},
  {"if (A > 5) then",         swap("\\bif ([^\"]*?) then", "if ($1) then"),       "parentheses"},
  {"if A > 1 then if B > 2",  swap(" and ", " then if "),                         "`and`"},
  {"end // done",             swap("^(\\d+ [^\"']*[^\"';: ])$", "$1 // note"),     "`'`"},
  {"end # done",              swap("^(\\d+ [^\"']*[^\"';: ])$", "$1 # note"),      "`'`"},
  {"REM blink",               swap("^' ", "REM "),                                "`'`"},
  {"RGB(255,0,0)",            swap("\\bRGB ([^']*[^' ])$", "RGB($1)"),            "parentheses"},
  {"color 255,0,0",           swap("\\bRGB\\b", "color"),                         "`RGB"},
  {"RGB 255 0 0",             swap("\\bRGB (\\d+), ?(\\d+), ?(\\d+)", "RGB $1 $2 $3"), "comma"},
  {"RGB red",                 swap("\\bRGB 255, ?0, ?0", "RGB red"),              "`RGB 255,0,0`"},
  {"LEDC red",                swap("\\bRGB \\d+, ?\\d+, ?\\d+", "LEDC red"),   "`LEDC 1`"},
  {"roll 0,100,1",            swap("\\bgoroll\\b", "roll"),                       "`goroll"},
  {"goroll(0,100,1)",         swap("\\bgoroll ([^']*[^' ])$", "goroll($1)"),      "parentheses"},
  {"Let A = 5",               swap("^(\\d+) (?=[A-X] = )", "$1 Let "),            "leave it out"},
  {"int A = 5",               swap("^(\\d+) (?=[A-X] = )", "$1 int "),            "leave it out"},
  {"A += 1",                  swap("^(\\d+ ([A-X])) = \\2 \\+ ", "$1 += "),       "`A = A +"},
  {"A++",                     swap("^(\\d+ ([A-X])) = \\2 \\+ 1$", "$1++"),       " + 1`"},
  {"A := 5",                  swap("^(\\d+ [A-X]) = ", "$1 := "),                 "`=`"},
  {"count = 5",               long_name("count"),                                 "A to Z"},
  {"next",                    swap("\\bnext [A-X]\\b", "next"),                   "`next "},
  {"print \"hi\", no number", swap("^\\d+ (?=print)", ""),                        "number"},
  {"a file without numbers",  unnumbered_file(),                                  "--fix"},
  {"A mod 2",                 swap("^(\\d+ [^\"']*) % ", "$1 mod "),              "%"},
  {"RND(1)*6",                swap("\\brnd (\\d+)\\b", "RND(1)*$1"),              "`rnd "},
  {"random(6)",               swap("\\brnd (\\d+)\\b", "random($1)"),             "`rnd "},
  {"A = 0xFF",                swap("^(\\d+ [A-X] = )255\\b", "$010xFF"),          "`255`"},
  {"A = 5: B = 6",            colon(),                                            "line of its own"},
  {"goto start",              swap("\\bgoto \\d+", "goto start"),                 "number"},
  {"call 100",                swap("\\bgosub\\b", "call"),                        "`gosub"},
  {"delay 500;",              swap("\\bdelay (\\d+)$", "delay $1;"),              "leave it out"},
  {"goto 9999",               swap("\\bgoto \\d+", "goto 9999"),                  "no line 9999"},
  {"next Q",                  swap("\\bnext [A-P]\\b", "next Q"),                 "Q"},
  {"A >= 5",                  swap("^(\\d+ if [A-X]) > ", "$1 >= "),              "`>"},
  {"while A < 5",             insert_below("while A < 5"),                        "`if A < 5 then goto"},
  {"endif",                   insert_below("endif"),                              "leave this line out"},
};
// clang-format on

struct Count {
  std::size_t planted = 0;
  std::size_t explained = 0;
  std::size_t mended = 0; ///< by `--fix`, to a program without errors
};

std::string join(const Lines& lines) {
  std::string text;
  for (const auto& line : lines)
    text += line + '\n';
  return text;
}

std::set<std::string_view> errors_of(const std::vector<orb::Diagnostic>& findings) {
  std::set<std::string_view> errors;
  for (const auto& d : findings)
    if (d.severity == Severity::Error)
      errors.insert(d.rule->id);
  return errors;
}

std::size_t count_errors(const std::vector<orb::Diagnostic>& findings) {
  return static_cast<std::size_t>(
      std::count_if(findings.begin(), findings.end(),
                    [](const auto& d) { return d.severity == Severity::Error; }));
}

/// Whether a finding on that line says what is expected of it.
bool is_explained(const orb::compiler::Checked& checked, std::size_t line,
                  const std::string& expected) {
  const auto span = checked.program.lines.at(line).span;
  return std::any_of(checked.diagnostics.begin(), checked.diagnostics.end(), [&](const auto& d) {
    const auto words = d.message + "\n" + d.help + (d.fix ? "\n" + d.fix->title : "");
    return span.begin <= d.span.begin && d.span.begin <= span.end &&
           words.find(expected) != std::string::npos;
  });
}

class Campaign {
public:
  void plant_all(const std::string& name, const Lines& program) {
    for (std::size_t kind = 0; kind < slips.size(); ++kind)
      for (std::size_t i = 0; i < program.size(); ++i) {
        auto changed = program;
        if (slips[kind].plant(changed, i) && changed != program)
          measure(name, kind, join(changed), i);
      }
  }

  const std::vector<Count>& counts() const { return counts_; }
  std::size_t wrong_fixes() const { return wrong_fixes_; }

private:
  void measure(const std::string& name, std::size_t kind, const std::string& text,
               std::size_t line) {
    const auto before = orb::compiler::check(text, {});
    if (before.diagnostics.empty())
      return; // the same program in other words
    auto& count = counts_[kind];
    ++count.planted;
    if (is_explained(before, line, expected_of(kind, text, line)))
      ++count.explained;
    else
      std::cerr << fmt::format("{}:{}: `{}` is not explained\n", name, line + 1,
                               slips[kind].example);
    const auto fixed = orb::compiler::fix(text, {});
    const auto after = orb::compiler::check(fixed.text, {});
    const auto known = errors_of(before.diagnostics);
    const auto left = errors_of(after.diagnostics);
    count.mended += left.empty() && fixed.count > 0 ? 1 : 0;
    if (count_errors(after.diagnostics) > count_errors(before.diagnostics) ||
        !std::includes(known.begin(), known.end(), left.begin(), left.end())) {
      ++wrong_fixes_;
      std::cerr << fmt::format("{}:{}: the fixes of `{}` leave other errors:\n{}\n", name, line + 1,
                               slips[kind].example, fixed.text);
    }
  }

  /// `A` of an expectation stands for the letter of the line.
  static std::string expected_of(std::size_t kind, const std::string& text, std::size_t line) {
    auto expected = slips[kind].expected;
    if (expected != "`A = A +")
      return expected;
    std::size_t begin = 0;
    for (std::size_t n = 0; n < line; ++n)
      begin = text.find('\n', begin) + 1;
    const char letter = text[text.find(' ', begin) + 1];
    return fmt::format("`{0} = {0} +", letter);
  }

  std::vector<Count> counts_ = std::vector<Count>(slips.size());
  std::size_t wrong_fixes_ = 0;
};

std::string read(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

Lines lines_of(const std::string& text) {
  Lines lines;
  for (std::size_t at = 0; at < text.size();) {
    const auto end = std::min(text.find('\n', at), text.size());
    lines.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return lines;
}

std::string page(const std::vector<Count>& counts, std::size_t programs) {
  Count all;
  std::string rows;
  for (std::size_t kind = 0; kind < slips.size(); ++kind) {
    const auto& count = counts[kind];
    all.planted += count.planted;
    all.explained += count.explained;
    all.mended += count.mended;
    rows += fmt::format("| `{}` | {} | {} | {} |\n",
                        std::regex_replace(slips[kind].example, std::regex("\\|"), "\\|"),
                        count.planted, count.explained, count.mended);
  }
  const auto share = [&](std::size_t n) {
    return fmt::format("{:.1f} %",
                       100.0 * static_cast<double>(n) / static_cast<double>(all.planted));
  };
  return fmt::format(
      "# Slips\n\n"
      "What beginners write who know another language, planted one at a time into {} programs of\n"
      "[examples](../examples). *Explained* counts the slips for which `orb check` has a finding "
      "on their\n"
      "line that names the line to write; *fixed* those after which `orb check --fix` leaves "
      "no error.\n"
      "No fix ever leaves more errors, or others. The page is printed by a test "
      "(`build/dev/bin/slips . "
      "--update`).\n\n"
      "What stays has no fix that is right for certain: nobody knows which line `goto start` and\n"
      "`goto 9999` mean, nor where the block of a `while` ends; a `wait` of up to 15 may have been "
      "meant in\n"
      "seconds; and a word without quotes that is also a misspelt variable may be either.\n\n"
      "**{} of {} explained: {}; {} fixed: {}.**\n\n"
      "| slip | planted | explained | fixed |\n|---|--:|--:|--:|\n{}",
      programs, all.explained, all.planted, share(all.explained), all.mended, share(all.mended),
      rows);
}

} // namespace

int main(int argc, char** argv) {
  if (argc < 2)
    return 2;
  const fs::path root = argv[1];
  const bool update = argc > 2 && std::string_view(argv[2]) == "--update";
  std::vector<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(root / "examples"))
    if (entry.path().extension() == ".bas")
      paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  Campaign campaign;
  for (const auto& path : paths)
    campaign.plant_all(path.filename().string(), lines_of(read(path)));

  const auto text = page(campaign.counts(), paths.size());
  Count all;
  for (const auto& count : campaign.counts()) {
    all.planted += count.planted;
    all.explained += count.explained;
    all.mended += count.mended;
  }
  std::cout << text;
  const auto target = root / "docs" / "slips.md";
  if (update)
    std::ofstream(target, std::ios::binary) << text;
  constexpr std::size_t least_percent = 95;
  const bool current = read(target) == text;
  if (!current)
    std::cerr
        << "docs/slips.md is not what this prints; run with --update and read the difference\n";
  const auto enough = [&](std::size_t n) { return n * 100 >= all.planted * least_percent; };
  return current && campaign.wrong_fixes() == 0 && enough(all.explained) && enough(all.mended) ? 0
                                                                                               : 1;
}
