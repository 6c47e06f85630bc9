#include "reference/manual.h"

#include "base/exit_code.h"
#include "base/text/utf8.h"
#include "reference/knowledge.h"
#include "spec/limits.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <string_view>

namespace orb::reference {
namespace {

constexpr std::size_t line_width = 76; // bytes; mandoc wants source lines of at most 80
constexpr std::string_view date = "November 21, 2026";

std::string_view take_code_point(std::string_view& text) {
  const auto length = std::max<std::size_t>(1, utf8_length(text));
  const auto front = text.substr(0, length);
  text.remove_prefix(length);
  return front;
}

/// The number of a code point; the text must be valid UTF-8.
std::uint32_t scalar(std::string_view utf8) {
  const auto byte = [&](std::size_t i) {
    return static_cast<std::uint32_t>(static_cast<std::uint8_t>(utf8[i]));
  };
  switch (utf8.size()) {
  case 2: return (byte(0) & 0x1FU) << 6 | (byte(1) & 0x3FU);
  case 3: return (byte(0) & 0x0FU) << 12 | (byte(1) & 0x3FU) << 6 | (byte(2) & 0x3FU);
  case 4:
    return (byte(0) & 0x07U) << 18 | (byte(1) & 0x3FU) << 12 | (byte(2) & 0x3FU) << 6 |
           (byte(3) & 0x3FU);
  default: return byte(0);
  }
}

/// Escapes what roff would interpret.
std::string escape(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const auto point = take_code_point(text);
    if (point == "\\")
      out += "\\e";
    else if (point == "-")
      out += "\\-";
    else if (point == "'")
      out += "\\(aq";
    else if (point == "`")
      out += "\\(ga";
    else if (point == "^")
      out += "\\(ha";
    else if (point == "~")
      out += "\\(ti";
    else if (point == "\"")
      out += "\\(dq";
    else if (point.size() > 1)
      out += fmt::format("\\[u{:04X}]", scalar(point));
    else
      out += point;
  }
  return out;
}

/// Formats running text as source lines: filled, a new line after each sentence, `code` in bold.
std::string prose(std::string_view text) {
  std::string out;
  std::string line;
  bool bold = false;
  const auto flush = [&] {
    if (!line.empty())
      out += (line.front() == '.' || line.front() == '\\' ? "\\&" : "") + line + "\n";
    line.clear();
  };
  while (!text.empty()) {
    const auto end = std::min(text.find_first_of(" \n"), text.size());
    auto word = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (word.empty())
      continue;
    const bool ends_sentence = word.size() > 1 && (word.back() == '.' || word.back() == '?');
    std::string piece;
    while (!word.empty()) {
      const auto tick = std::min(word.find('`'), word.size());
      piece += escape(word.substr(0, tick));
      if (tick < word.size()) {
        bold = !bold;
        piece += bold ? "\\fB" : "\\fR";
      }
      word.remove_prefix(std::min(tick + 1, word.size()));
    }
    if (!line.empty() && line.size() + 1 + piece.size() > line_width)
      flush();
    line += (line.empty() ? "" : " ") + piece;
    if (ends_sentence && !bold)
      flush();
  }
  if (bold)
    line += "\\fR";
  flush();
  return out;
}

/// Protects a word in the arguments of a macro: it cannot be taken for another macro.
std::string word(std::string_view text) {
  std::string out;
  bool at_start = true;
  for (const char c : text) {
    if (at_start && c != ' ')
      out += "\\&";
    at_start = c == ' ';
    out += escape(std::string_view(&c, 1));
  }
  return out;
}

std::string literal(std::string_view lines) {
  std::string out = ".Bd -literal -offset indent\n";
  while (!lines.empty()) {
    const auto end = std::min(lines.find('\n'), lines.size());
    const auto line = escape(lines.substr(0, end));
    out += (line.starts_with(".") || line.starts_with("\\(aq") ? "\\&" : "") + line + "\n";
    lines.remove_prefix(std::min(end + 1, lines.size()));
  }
  return out + ".Ed\n";
}

std::string upper(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'a' && c <= 'z')
      c = static_cast<char>(c - 'a' + 'A');
  return out;
}

/// A summary for `.Nd`: one line without a full stop.
std::string summary_line(std::string_view text) {
  std::string out;
  for (const char c : text.substr(0, text.find('\n')))
    if (c != '`')
      out += c;
  if (out.ends_with("."))
    out.pop_back();
  return escape(out);
}

std::string head(std::string_view name, int section, std::string_view summary) {
  return fmt::format(".\\\" Printed by orb man; the tables and the option model are the source.\n"
                     ".Dd {}\n.Dt {} {}\n.Os\n.Sh NAME\n.Nm {}\n.Nd {}\n",
                     date, upper(name), section, name, summary_line(summary));
}

/// `Fl o Ar FILE , Fl Fl out Ns = Ns Ar FILE`
std::string flags_of(const Option& option) {
  std::string out;
  for (const auto& name : option.short_names)
    out += fmt::format("{}Fl {}", out.empty() ? "" : " , ", word(name));
  for (const auto& name : option.long_names)
    out += fmt::format("{}Fl Fl {}", out.empty() ? "" : " , ", word(name));
  if (!option.placeholder.empty())
    out += fmt::format("{} Ar {}", option.optional_value ? " Ns Op = Ns" : "",
                       word(option.placeholder));
  return out;
}

std::string synopsis(const Command& command) {
  std::string out = ".Sh SYNOPSIS\n";
  out += fmt::format(".Nm orb {}\n", word(command.name));
  for (const auto& option : command.options)
    if (option.argument.empty() && !option.asks_for_help)
      out += fmt::format(".{}{}\n", option.required ? "" : "Op ", flags_of(option));
  for (const auto& option : command.options)
    if (!option.argument.empty())
      out += fmt::format(".{} {}{}\n", option.required ? "Ar" : "Op Ar", word(option.argument),
                         option.most > 1 ? " ..." : "");
  return out;
}

std::string capitalised(std::string text) {
  if (!text.empty() && text.front() >= 'a' && text.front() <= 'z')
    text.front() = static_cast<char>(text.front() - 'a' + 'A');
  return text;
}

std::string sentence(std::string text) {
  text = capitalised(std::move(text));
  if (!text.empty() && text.back() != '.' && text.back() != '?')
    text += '.';
  return text;
}

std::string options_list(const Command& command) {
  std::string out;
  for (const auto& option : command.options) {
    out += option.argument.empty() ? fmt::format(".It {}\n", flags_of(option))
                                   : fmt::format(".It Ar {}\n", word(option.argument));
    auto text = sentence(option.summary);
    if (!option.words.empty())
      text += fmt::format(" One of {}.", fmt::join(option.words, ", "));
    if (!option.default_value.empty())
      text += fmt::format(" The default is `{}`.", option.default_value);
    if (!option.environment.empty())
      text += fmt::format(" The environment variable `{}` sets it too.", option.environment);
    out += prose(text);
  }
  return out.empty() ? out : ".Bl -tag -width Ds\n" + out + ".El\n";
}

std::string exit_status() {
  std::string out = ".Sh EXIT STATUS\n.Bl -tag -width Ds -compact\n";
  for (const auto& row : exit_codes)
    out += fmt::format(".It {}\n{}", static_cast<int>(row.code),
                       prose(sentence(std::string(row.meaning))));
  return out + ".El\n";
}

/// A reference to a page of this manual. Not `.Xr`: the linter would look for the page among
/// installed ones.
std::string reference(std::string_view file) {
  const auto dot = file.rfind('.');
  return fmt::format("\\fB{}\\fR({})", escape(file.substr(0, dot)), file.substr(dot + 1));
}

std::string see_also(const std::vector<std::string>& pages) {
  std::string out = ".Sh SEE ALSO\n";
  for (std::size_t i = 0; i < pages.size(); ++i)
    out += reference(pages[i]) + (i + 1 < pages.size() ? ",\n" : "\n");
  return out;
}

ManualPage command_page(const CommandLine& line, const Command& command) {
  const auto name = "orb-" + command.name;
  auto text = head(name, 1, command.summary) + synopsis(command);
  text += ".Sh DESCRIPTION\n" + prose(sentence(command.summary));
  if (!command.details.empty())
    text += ".Pp\n" + prose(command.details);
  text += ".Pp\nThe options are as follows:\n" + options_list(command);
  text += ".Pp\nThe options\n";
  std::string common;
  for (const auto& option : line.orb.options)
    if (!option.asks_for_help)
      common +=
          fmt::format("{}.Fl Fl {}", common.empty() ? "" : " ,\n", word(option.long_names.front()));
  text += common + "\nof\n" + reference("orb.1") + "\nmay be used here too.\n";
  text += exit_status();
  text += ".Sh EXAMPLES\n" + literal(command.examples);
  text += see_also({"orb.1", "orb-macro.7", "orbbasic.7"});
  return {name + ".1", text};
}

ManualPage main_page(const CommandLine& line) {
  auto text = head("orb", 1, "toolchain for Sphero robots: orbBasic and macros");
  text += ".Sh SYNOPSIS\n.Nm orb\n.Ar command\n.Op Ar option ...\n.Op Ar argument ...\n";
  text += ".Sh DESCRIPTION\n" + prose(line.orb.summary);
  text += ".Pp\nThe commands are as follows; each has its own page:\n.Bl -tag -width Ds\n";
  std::vector<std::string> pages;
  for (const auto& command : line.commands) {
    pages.push_back("orb-" + command.name + ".1");
    text += fmt::format(".It {}\n{}", reference(pages.back()), prose(sentence(command.summary)));
  }
  text += ".El\n.Pp\nThe options that can come before or after any command are as follows:\n" +
          options_list(line.orb);
  text += ".Sh ENVIRONMENT\n.Bl -tag -width Ds\n"
          ".It Ev ORB_PORT\n.It Ev ORB_TARGET\n"
          "Stand in for\n.Fl Fl port\nand\n.Fl Fl target\nwhere these are not given.\n"
          ".It Ev NO_COLOR\n.It Ev CLICOLOR_FORCE\n"
          "Switch colour off, or on even when the output is not a terminal.\n"
          ".It Ev ORB_PERF_MAP\n"
          "Lets\n.Nm orb Cm run\nwrite\n.Pa /tmp/perf-PID.map ,\n"
          "which tells\n.Ql perf report\nwhich lines the machine code belongs to.\n.El\n";
  text += ".Sh FILES\n.Bl -tag -width Ds\n"
          ".It Pa orb.toml\n"
          "The configuration of a project, found in the working folder or one above it.\n"
          "A section\n.Li [balls]\nnames balls\n.Pq Li red = \\(dqrfcomm://...\\(dq\n"
          "that are used as\n.Li @red ;\n"
          "other sections set options of the command with that name:\n"
          "targets, rule levels, layout and budgets, but not outputs.\n"
          "The search ends at the root of the repository or at the home folder.\n"
          ".It Pa $XDG_CONFIG_HOME/orb/config.toml\n"
          "The same for all projects, and for any option; overridden by\n.Pa orb.toml .\n.El\n";
  text += exit_status();
  text += ".Sh EXAMPLES\n" + literal(line.orb.examples);
  std::sort(pages.begin(), pages.end());
  pages.emplace_back("orb-macro.7");
  pages.emplace_back("orbbasic.7");
  text += see_also(pages);
  return {"orb.1", text};
}

std::string entry_text(const Entry& entry) {
  auto out = fmt::format(".It Ic {}\n{}", word(entry.name), prose(sentence(entry.summary)));
  if (!entry.explanation.empty())
    out += ".Pp\n" + prose(entry.explanation);
  std::string facts;
  for (const auto& [caption, value] : entry.facts)
    facts += fmt::format(".It {}\n{}", word(caption), prose(value));
  if (!facts.empty())
    out += ".Bl -tag -width Ds -compact\n" + facts + ".El\n";
  for (const auto& [caption, source] : entry.code)
    out += literal(source);
  return out;
}

std::string section_text(const Section& section) {
  auto out = fmt::format(".Sh {}\n.Bl -tag -width Ds\n", upper(section.title));
  for (const auto& entry : section.entries)
    out += entry_text(entry);
  return out + ".El\n";
}

constexpr std::string_view basic_intro =
    "orbBasic is the programming language inside first-generation Sphero robots. "
    "A program is a list of lines, and each line is a number from {} to {}, at least one space, "
    "and one statement. The lines run in the order of the text, about 3000 a second. Keywords "
    "and system variables are written exactly as on this page: `RGB` is a statement, `rgb` is not. "
    "A single quote begins a comment, which never reaches the robot.";
constexpr std::string_view basic_values =
    "Values are 32-bit integers. The variables are `A` to `Y`, the same as `a` to `y`; "
    "`Z` is the element of a set of 25 that `Y` names. All are 0 when a program begins. "
    "Parentheses bind strongest, then `* / % { }`, then `+ - & |`; operators of the same level "
    "associate to the left. "
    "A condition is two expressions with one of `= ! < >` between them; at most two can be "
    "joined by `and` or `or`.";
constexpr std::string_view basic_example = "10 for H = 0 to 270 step 90\n"
                                           "20 goroll H,100,1\n"
                                           "30 delay 1000\n"
                                           "40 next H\n"
                                           "50 goroll 0,0,0";
constexpr std::string_view macro_intro =
    "A macro is a short list of commands that runs inside a Sphero robot with a one-"
    "millisecond clock, without arithmetic or conditions. This page lists the commands and flags "
    "as the "
    "assembler takes them: one command per line, its operands separated by commas or "
    "given "
    "by name, `delay=` last; `#` begins a comment. `.macro` names a macro and gives its id and "
    "flags, `.const` names a "
    "number, `.raw` inserts bytes as they are; an End is added where none is written.";
constexpr std::string_view macro_example = ".macro blink id=40 flags=motor_control\n"
                                           "  loop_start 3\n"
                                           "    rgb 255, 0, 0, delay=250ms\n"
                                           "    rgb 0, 0, 0, delay=250ms\n"
                                           "  loop_end";

ManualPage basic_page(const std::vector<Section>& sections) {
  auto text = head("orbbasic", 7, "the programming language of Sphero robots");
  text += ".Sh DESCRIPTION\n" +
          prose(fmt::format(basic_intro, spec::value_of(spec::Limit::LeastLineNumber),
                            spec::value_of(spec::Limit::GreatestLineNumber))) +
          ".Pp\n" + prose(basic_values);
  for (const auto* id :
       {"statements", "functions", "variables", "operators", "errors", "limits", "basic-flags"})
    for (const auto& section : sections)
      if (section.id == id)
        text += section_text(section);
  text += ".Sh EXAMPLES\nA square:\n" + literal(basic_example);
  return {"orbbasic.7", text + see_also({"orb.1", "orb-check.1", "orb-run.1", "orb-macro.7"})};
}

ManualPage macro_page(const std::vector<Section>& sections) {
  auto text = head("orb-macro", 7, "macros for Sphero robots");
  text += ".Sh DESCRIPTION\n" + prose(macro_intro);
  for (const auto& section : sections)
    if (section.id.starts_with("macro-") && section.id.find("rules") == std::string_view::npos)
      text += section_text(section);
  text += ".Sh EXAMPLES\nThree blinks:\n" + literal(macro_example);
  return {"orb-macro.7", text + see_also({"orb.1", "orb-asm.1", "orb-run.1", "orbbasic.7"})};
}

} // namespace

std::vector<ManualPage> manual(const CommandLine& line) {
  std::vector<ManualPage> pages{main_page(line)};
  for (const auto& command : line.commands)
    pages.push_back(command_page(line, command));
  const auto sections = knowledge();
  pages.push_back(basic_page(sections));
  pages.push_back(macro_page(sections));
  return pages;
}

} // namespace orb::reference
