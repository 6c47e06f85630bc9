#include "compiler/lint.h"

#include "base/silence.h"
#include "compiler/findings.h"
#include "compiler/image.h"
#include "compiler/messages.h"
#include "compiler/range.h"
#include "compiler/rules.h"
#include "compiler/words.h"
#include "spec/limits.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <fmt/format.h>

namespace orb::compiler {
namespace {

constexpr std::size_t letters = 25; // A to Y
constexpr std::uint32_t index_letter = 24;
static_assert(letters == spec::value_of(spec::Limit::DirectVariables));

char letter_name(std::uint32_t index) {
  return static_cast<char>('A' + index);
}

constexpr std::uint32_t bit(std::uint32_t n) {
  return std::uint32_t{1} << n;
}

std::string shown(Range range) {
  return range.constant() ? fmt::format("{}", range.lo)
                          : fmt::format("{} to {}", range.lo, range.hi);
}

bool is_unusual(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return byte >= 0x7F || (byte < ' ' && c != '\n');
}

/// Whether a byte other than printable ASCII and LF occurs. Eight bytes are asked at once whether
/// one may be: a text is read faster than it is parsed.
bool has_unusual_byte(std::string_view text) {
  constexpr std::uint64_t ones = 0x0101010101010101;
  constexpr std::uint64_t high = 0x80 * ones;
  const auto any = [](std::string_view part) {
    return std::any_of(part.begin(), part.end(), is_unusual);
  };
  while (text.size() >= sizeof(std::uint64_t)) {
    std::uint64_t word = 0;
    std::memcpy(&word, text.data(), sizeof word);
    const auto below_blank = (word - ' ' * ones) & ~word & high;
    const auto above_tilde = (word + ones) & high;
    if (((below_blank | above_tilde | (word & high)) != 0) && any(text.substr(0, sizeof word)))
      return true;
    text.remove_prefix(sizeof word);
  }
  return any(text);
}

/// How a letter gets its values, over the whole program.
struct Letter {
  const Item* first_set = nullptr; ///< null where nothing sets it
  std::uint32_t first_used = none; ///< node
  std::uint32_t set_line = none;
  std::uint32_t used_line = none;
  bool assigned = false; ///< by let, read or input
  bool counted = false;  ///< by for
};

/// The passes that go through the statements in the order of the text, and those before and after.
class Linter {
public:
  Linter(const Program& program, const Target& target)
      : program_(program), target_(target), findings_(program), flow_(read_flow(program)) {}

  std::vector<Diagnostic> run() {
    for (const auto& fault : program_.faults)
      findings_.add(explain(program_, fault));
    check_bytes();
    collect_letters();
    check_lines();
    check_statements();
    check_letters();
    const bool jumps_known =
        std::none_of(program_.faults.begin(), program_.faults.end(),
                     [&](const Fault& fault) { return may_steer(program_, fault); });
    if (jumps_known)
      lint_flow(program_, flow_, findings_);
    check_size();
    silence();
    sort_by_place(findings_.all());
    return std::move(findings_.all());
  }

private:
  // ---- the whole text

  void check_bytes() {
    if (!has_unusual_byte(program_.text))
      return;
    for (std::uint32_t i = 0; i < program_.lines.size(); ++i)
      check_bytes_of(i);
    check_line_ends();
  }

  void check_bytes_of(std::uint32_t index) {
    const auto& line = program_.lines[index];
    const auto end = line.comment.size() > 0 ? line.comment.begin : line.span.end;
    bool in_string = false;
    bool tab_seen = false;
    bool byte_seen = false;
    for (auto i = line.span.begin; i < end; ++i) {
      const auto c = static_cast<unsigned char>(program_.text[i]);
      in_string = in_string != (c == '"');
      if (c == '\t' && !in_string && !tab_seen) {
        tab_seen = true;
        add_tab(index, i, end);
      } else if ((c < ' ' || c >= 0x7F) && (c != '\t' || in_string) && !byte_seen) {
        byte_seen = true;
        findings_.add(rules::NonprintingByte, index, {i, i + 1},
                      fmt::format("byte {:02X} is not printable ASCII", c), "write plain letters");
      }
    }
  }

  void add_tab(std::uint32_t index, std::uint32_t first, std::uint32_t end) {
    auto& d = findings_.add(rules::Tab, index, {first, first + 1},
                            "a tab stands where a blank belongs", "write a blank");
    Fix fix{"write blanks", {}, Safety::Safe};
    bool in_string = false;
    for (auto i = program_.lines[index].span.begin; i < end; ++i) {
      in_string = in_string != (program_.text[i] == '"');
      if (program_.text[i] == '\t' && !in_string)
        fix.edits.push_back({{i, i + 1}, " "});
    }
    d.fix = std::move(fix);
  }

  void check_line_ends() {
    const auto at = program_.text.find('\r');
    if (at == std::string_view::npos)
      return;
    const auto begin = static_cast<std::uint32_t>(at);
    const bool pair = at + 1 < program_.text.size() && program_.text[at + 1] == '\n';
    auto& d = findings_.add(rules::LineEnding, none, {begin, begin},
                            fmt::format("lines end in {}", pair ? "CRLF" : "CR"),
                            "the robot's documents ask for LF alone");
    Fix fix{"end lines in LF", {}, Safety::Safe};
    for (auto i = begin; i < program_.text.size(); ++i)
      if (program_.text[i] == '\r') {
        const bool followed = i + 1 < program_.text.size() && program_.text[i + 1] == '\n';
        fix.edits.push_back({{i, i + 1}, followed ? "" : "\n"});
      }
    d.fix = std::move(fix);
  }

  void check_size() {
    if (flow_.code.empty())
      return;
    const auto size = static_cast<std::int32_t>(image_size(program_));
    const auto room = area_bytes(target_);
    const auto oldest = spec::value_of(spec::Limit::RamBytesUntil146);
    const bool in_ram = target_.area == Area::Ram;
    if (size > room) {
      const auto line = line_at_byte(room);
      findings_.add(rules::ProgramTooLarge, line, program_.lines[line].span,
                    fmt::format("the program takes {} bytes, {} more than the {} of the {} area",
                                size, size - room, room, in_ram ? "RAM" : "flash"),
                    "`orb build --pack` makes it smaller");
    } else if (in_ram && !target_.ram_bytes && size > oldest) {
      const auto line = line_at_byte(oldest);
      findings_.add(rules::LargerThanOldRam, line, program_.lines[line].span,
                    fmt::format("the program takes {} bytes; older robots have {}", size, oldest),
                    "give `--ram 4096` if yours has more");
    }
  }

  /// The line that holds byte `room` of the image: the first that does not fit.
  std::uint32_t line_at_byte(std::int32_t room) const {
    std::int32_t size = 1;
    for (const auto& code : flow_.code) {
      size += static_cast<std::int32_t>(image_size(program_, code.line));
      if (size > room)
        return code.line;
    }
    return flow_.code.back().line;
  }

  // ---- lines

  void check_lines() {
    std::uint32_t last = 0;
    bool ascending = true;
    for (std::uint32_t i = 0; i < program_.lines.size(); ++i) {
      const auto& line = program_.lines[i];
      if (!line.has_number())
        continue;
      if (line.number == 0)
        findings_.add(rules::LineNumberRange, i, line.number_span,
                      "line number 0 is not 1 to 65535");
      if (line.number <= last && i > 0)
        ascending = false;
      if (line.number < last)
        findings_.add(rules::UnsortedLines, i, line.number_span,
                      fmt::format("line {} stands below line {}", line.number, last),
                      "lines run in the order of the text; `orb fmt --renumber` puts it right");
      last = line.number;
      if (!line.has_statement())
        add_empty_line(i);
      else if (!is_blank(program_.text[line.number_span.end]))
        add_missing_blank(i, line.number_span.end, "the line number");
    }
    if (!ascending)
      check_duplicates();
  }

  void add_empty_line(std::uint32_t index) {
    const auto& line = program_.lines[index];
    auto& d = findings_.add(rules::LineWithoutStatement, index, line.number_span,
                            fmt::format("line {} holds no statement and is dropped", line.number),
                            line.comment.size() > 0 ? "a comment needs no number" : "");
    if (line.number == none - 1 || is_target(line.number))
      return;
    if (line.comment.size() > 0)
      d.fix = single_fix("remove the number", {line.span.begin, line.comment.begin}, "");
  }

  /// Whether some jump names the line; the jumps are sorted once, when this is first asked.
  bool is_target(std::uint32_t number) {
    if (!targets_sorted_) {
      targets_sorted_ = true;
      for (const auto& part : program_.items)
        if (part.kind == ItemKind::Target)
          targets_.push_back(part.value);
      std::sort(targets_.begin(), targets_.end());
    }
    return std::binary_search(targets_.begin(), targets_.end(), number);
  }

  void check_duplicates() {
    constexpr std::size_t most_fixes = 64; // the rest gets its turn when these are mended
    std::size_t first = 0;
    std::size_t found = 0;
    for (std::size_t i = 1; i < flow_.numbers.size(); ++i) {
      const auto& row = flow_.numbers[i];
      if (row.number != flow_.numbers[first].number) {
        first = i;
        continue;
      }
      const auto& line = program_.lines[row.line];
      auto& d = findings_.add(rules::DuplicateLine, row.line, line.number_span,
                              fmt::format("line number {} is taken already", row.number));
      const auto& original = program_.lines[flow_.numbers[first].line];
      d.notes.push_back({original.number_span, "the first line of that number"});
      if (++found > most_fixes)
        continue;
      if (const auto free = free_number(row.line)) {
        d.help = fmt::format("{} is free here", *free);
        d.fix = single_fix(fmt::format("renumber to {}", *free), line.number_span,
                           std::to_string(*free));
      }
    }
  }

  /// A number between those of the neighbours that no line and no jump has.
  std::optional<std::uint32_t> free_number(std::uint32_t index) {
    std::uint32_t below = 0;
    for (std::uint32_t i = 0; i <= index; ++i)
      if (program_.lines[i].has_number())
        below = program_.lines[i].number;
    auto above = static_cast<std::uint32_t>(spec::value_of(spec::Limit::GreatestLineNumber)) + 1;
    for (auto i = index + 1; i < program_.lines.size(); ++i)
      if (program_.lines[i].has_number() && program_.lines[i].number > below) {
        above = program_.lines[i].number;
        break;
      }
    constexpr std::uint32_t tries = 100;
    const auto middle = above - below > 20 ? below + 10 : below + (above - below) / 2;
    for (std::uint32_t n = middle; n < above && n < middle + tries; ++n)
      if (n > below && flow_.find(n) == nullptr && !is_target(n))
        return n;
    for (std::uint32_t n = below + 1; n < middle && n < below + tries; ++n)
      if (flow_.find(n) == nullptr && !is_target(n))
        return n;
    return std::nullopt;
  }

  void add_missing_blank(std::uint32_t line, std::uint32_t at, std::string_view what) {
    if (blank_line_ == line)
      return; // one for a line is enough
    blank_line_ = line;
    auto& d = findings_.add(rules::MissingBlank, line, {at, at},
                            fmt::format("a blank is missing beside {}", what));
    d.fix = single_fix("insert a blank", {at, at}, " ");
  }

  /// What a comment `' orb: allow RULE` names is left out on its line, or on the next one when it
  /// stands alone.
  void silence() {
    std::vector<AllowComment> comments;
    for (std::size_t i = 0; i < program_.lines.size(); ++i) {
      const auto& line = program_.lines[i];
      if (line.comment.size() == 0 ||
          program_.text_of(line.comment).find(allow_mark) == std::string_view::npos)
        continue;
      const bool alone = !line.has_number() && !line.has_statement();
      const auto about = alone ? i + 1 : i;
      comments.push_back({line.comment, about < program_.lines.size()
                                            ? line_span(program_.lines[about].span)
                                            : Span{}});
    }
    if (comments.empty())
      return;
    orb::silence(program_.text, comments, rules::all(), rules::UnknownRule, findings_.all());
    findings_.place();
  }

  /// With the place where the line ends.
  static Span line_span(Span line) { return {line.begin, line.end + 1}; }

  // ---- letters

  void collect_letters() {
    for (const auto& code : flow_.code) {
      for (const auto& statement : program_.whole(program_.statements[code.statement]))
        collect_set(statement, code.line);
    }
  }

  void collect_set(const StatementNode& statement, std::uint32_t line) {
    if (statement.error)
      return;
    for (const auto& item : program_.items_of(statement)) {
      if (item.kind != ItemKind::Letter || statement.kind == spec::Statement::Next)
        continue;
      auto& letter = letters_[item.value];
      if (letter.first_set == nullptr) {
        letter.first_set = &item;
        letter.set_line = line;
      }
      (statement.kind == spec::Statement::For ? letter.counted : letter.assigned) = true;
    }
  }

  void check_letters() {
    const bool silent = !program_.faults.empty(); // a line that does not parse may hold the rest
    for (std::uint32_t i = 0; i < letters && !silent; ++i) {
      const auto& letter = letters_[i];
      const bool used = letter.first_used != none;
      const bool set = letter.first_set != nullptr;
      if (set && !used && !letter.counted && !(i == index_letter && indexed_used_)) {
        findings_.add(rules::UnusedVariable, letter.set_line, letter.first_set->span,
                      fmt::format("`{}` is set but never used", letter_name(i)));
      } else if (used && !set) {
        findings_.add(rules::NeverAssigned, letter.used_line,
                      program_.nodes[letter.first_used].span,
                      fmt::format("`{}` is used but never set, so it is 0", letter_name(i)));
      }
    }
  }

  // ---- statements

  /// What is known about a letter at the start of a block, and until it is set within it.
  Range unknown_letter(std::uint32_t index) const {
    return letters_[index].first_set == nullptr ? Range::only(0) : Range{};
  }

  Range value_of_letter(std::uint32_t index) const {
    return stamps_[index] == block_ ? values_[index] : unknown_letter(index);
  }

  void set_letter(std::uint32_t index, Range range) {
    values_[index] = conditional_ ? join(value_of_letter(index), range) : range;
    stamps_[index] = block_;
  }

  /// Forgets all values: the line can be reached from elsewhere.
  void begin_block() {
    ++block_;
    data_size_ = unknown_data;
    data_left_ = unknown_data;
    data_unread_ = none;
    read_flags_ = 0;
  }

  void check_statements() {
    ranges_.resize(program_.nodes.size());
    bool falls = false;
    for (const auto& code : flow_.code) {
      if (code.target || !falls)
        begin_block();
      line_ = code.line;
      line_reads_ = 0;
      const auto& statement = program_.statements[code.statement];
      check(statement);
      if (!statement.error && statement.kind == spec::Statement::If)
        check_branches(statement);
      falls = code.falls && !statement.error; // a line that does not parse may set anything
      for (const auto& jump : flow_.jumps_of(code))
        if (jump.call)
          falls = false; // the subroutine may change everything
    }
  }

  void check_branches(const StatementNode& statement) {
    conditional_ = true;
    const auto reads = line_reads_;
    check_in_branch(program_.statements[statement.then_branch]);
    if (statement.else_branch != none) {
      line_reads_ = reads;
      check_in_branch(program_.statements[statement.else_branch]);
    }
    conditional_ = false;
  }

  void check_in_branch(const StatementNode& statement) {
    check(statement);
    if (statement.error)
      return;
    const auto& row = spec::info(statement.kind);
    if (row.in_then == spec::InThen::Unlisted)
      findings_.add(rules::UndocumentedInBranch, line_, statement.word,
                    fmt::format("`{}` is not documented inside `then` and `else`", row.word),
                    "jump to a line that holds it");
  }

  void check(const StatementNode& statement) {
    if (statement.error)
      return;
    const auto& row = spec::info(statement.kind);
    if (row.since > target_.version)
      add_newer(statement.word, row.word, row.since);
    evaluate(statement);
    check_blanks(statement);
    switch (statement.kind) {
    case spec::Statement::Let: check_let(statement); break;
    case spec::Statement::If: break;
    case spec::Statement::For: check_for(statement); break;
    case spec::Statement::Next: forget(statement); break;
    case spec::Statement::Goto:
    case spec::Statement::Gosub: check_targets(statement); break;
    case spec::Statement::On: check_on(statement); break;
    case spec::Statement::Print: check_print(statement); break;
    case spec::Statement::Input: check_input(statement); break;
    case spec::Statement::Data: check_data(statement); break;
    case spec::Statement::Rstr: data_left_ = conditional_ ? unknown_data : data_size_; break;
    case spec::Statement::Read: check_read(statement); break;
    case spec::Statement::Delay:
    case spec::Statement::Sleep: read_flags_ = 0; [[fallthrough]];
    case spec::Statement::Rgb:
    case spec::Statement::Ledc:
    case spec::Statement::BackLed:
    case spec::Statement::Goroll:
    case spec::Statement::Heading:
    case spec::Statement::Raw:
    case spec::Statement::Locate:
    case spec::Statement::Basflg:
    case spec::Statement::Macrun: check_arguments(statement); break;
    case spec::Statement::Return:
    case spec::Statement::End:
    case spec::Statement::Random:
    case spec::Statement::Tron:
    case spec::Statement::Troff:
    case spec::Statement::Reset:
    case spec::Statement::Mackill: break;
    }
  }

  void add_newer(Span span, std::string_view word, spec::BasicVersion since) {
    findings_.add(rules::NewerThanTarget, line_, span,
                  fmt::format("`{}` needs orbBasic {}, the target has {}", word,
                              spec::info(since).text, spec::info(target_.version).text));
  }

  Range range_of(const Item& expression) const { return ranges_[expression.value]; }

  void check_range(const Item& value, std::string_view word, const spec::Parameter& parameter) {
    const auto range = range_of(value);
    if (!range.misses(parameter.least, parameter.greatest))
      return;
    const auto name = parameter.name.empty() ? "" : fmt::format("{} ", parameter.name);
    findings_.add(rules::ValueOutOfRange, line_, value.span,
                  fmt::format("`{}` takes {}{} to {}, found {}", word, name, parameter.least,
                              parameter.greatest, shown(range)));
  }

  void check_arguments(const StatementNode& statement) {
    const auto& row = spec::info(statement.kind);
    const auto parameters = row.parameters();
    const auto arguments = program_.items_of(statement);
    for (std::size_t i = 0; i < arguments.size(); ++i)
      check_range(arguments[i], row.word, parameters[i]);
    if (statement.kind == spec::Statement::Goroll && arguments.size() < parameters.size())
      add_missing_go(statement, arguments.back());
    if (statement.kind == spec::Statement::Basflg)
      check_flags(arguments.front());
    if (statement.kind == spec::Statement::Sleep)
      check_sleep(program_.as<SleepView>(statement).line);
  }

  void add_missing_go(const StatementNode& statement, const Item& last) {
    const auto speed = range_of(last);
    auto& d =
        findings_.add(rules::MissingGo, line_, statement.span, "`goroll` takes 3 values, found 2",
                      "add the go value: 1 drives, 0 brakes");
    const auto end = last.span.end;
    if (speed.constant())
      d.fix =
          single_fix("add the go value", {end, end}, speed.lo > 0 ? ",1" : ",0", Safety::Unsafe);
  }

  void check_flags(const Item& value) {
    const auto range = range_of(value);
    const auto all = spec::value_of(spec::Limit::GreatestBasicFlags);
    if (range.lo > all &&
        !range.misses(0, spec::info(spec::Statement::Basflg).parameters()[0].greatest))
      findings_.add(rules::UnknownFlags, line_, value.span,
                    fmt::format("the flags are 1, 2, 4 and 8, found {}", shown(range)));
  }

  /// The line that runs after waking lies in flash; that is this program only when it is meant for
  /// flash.
  void check_sleep(const Item& value) {
    const auto range = range_of(value);
    if (!range.constant() || range.lo < 1 ||
        range.misses(1, spec::value_of(spec::Limit::GreatestLineNumber)))
      return;
    const auto* number = flow_.find(static_cast<std::uint32_t>(range.lo));
    if (number != nullptr && number->code != none)
      return;
    auto& d = findings_.add(number == nullptr ? rules::MissingTarget : rules::EmptyTarget, line_,
                            value.span, fmt::format("there is no line {} to wake up at", range.lo));
    if (target_.area == Area::Ram) {
      d.severity = Severity::Info;
      d.help = "the line is looked up in the flash area, which this program does not fill";
    }
  }

  void check_let(const StatementNode& statement) {
    const auto& [variable, value] = program_.as<LetView>(statement);
    if (statement.spelling == Spelling::Let) {
      auto& d = findings_.add(rules::UndocumentedLet, line_, statement.word,
                              "`let` is in no document", "leave it out");
      d.fix = single_fix("remove `let`", {statement.word.begin, variable.span.begin}, "");
    }
    if (variable.kind == ItemKind::Letter) {
      set_letter(variable.value, range_of(value));
    } else if (variable.kind == ItemKind::Indexed) {
      check_index(variable.span);
    } else if (static_cast<spec::Variable>(variable.value) != spec::Variable::Ctrl) {
      const auto& row = spec::variables[variable.value];
      check_range(value, row.word, {"", row.least, row.greatest, row.unit});
    }
  }

  void check_for(const StatementNode& statement) {
    const auto loop = program_.as<ForView>(statement);
    const auto& variable = loop.variable;
    const auto start = range_of(loop.start);
    const auto end = range_of(loop.end);
    const auto step = loop.step != nullptr ? range_of(*loop.step) : Range::only(1);
    if (step == Range::only(0))
      findings_.add(rules::ZeroStep, line_, loop.step->span, "the step of the loop is 0");
    const bool away = (step.lo > 0 && start.lo > end.hi) || (step.hi < 0 && start.hi < end.lo);
    if (away) {
      auto& d =
          findings_.add(rules::LoopRunsOnce, line_, {loop.start.span.begin, loop.last().span.end},
                        fmt::format("the loop counts from {} away from {}, so it runs once",
                                    shown(start), shown(end)));
      if (loop.step == nullptr)
        d.help = "to count down write `step -1`";
    }
    if (variable.kind == ItemKind::Indexed) {
      findings_.add(rules::IndexedLoop, line_, variable.span, "the loop counts in `Z`",
                    "count in one of A to X");
      check_index(variable.span);
      return;
    }
    // The first line of the body is entered from here and from `next`: of all letters only the
    // loop's own is known there, and only when nothing else sets it.
    begin_block();
    if (!letters_[variable.value].assigned)
      set_letter(variable.value, join(start, end));
  }

  /// A variable gets a value that is not known.
  void forget(const StatementNode& statement) {
    for (const auto& variable : program_.items_of(statement)) {
      if (variable.kind == ItemKind::Letter)
        set_letter(variable.value, {});
      else if (variable.kind == ItemKind::Indexed)
        check_index(variable.span);
    }
  }

  void check_index(Span span) {
    indexed_used_ = true;
    const auto& index = letters_[index_letter];
    const auto range = value_of_letter(index_letter);
    const auto most = spec::value_of(spec::Limit::IndexedVariables);
    if (range.misses(1, most)) {
      findings_.add(
          rules::IndexRange, line_, span,
          index.first_set == nullptr
              ? "`Z` is used, but `Y` is never set and 0 names no element"
              : fmt::format("`Z` is used while `Y` is {}; it must be 1 to {}", shown(range), most));
    } else if (index.set_line > line_ && !before_y_) {
      before_y_ = true;
      findings_.add(rules::IndexBeforeY, line_, span,
                    "`Z` is used above the first line that sets `Y`", "set `Y` to 1 … 25 first");
    }
  }

  void check_targets(const StatementNode& statement) {
    for (const auto& target : program_.items_of(statement)) {
      if (target.kind != ItemKind::Target)
        continue;
      const auto* number = flow_.find(target.value);
      if (number == nullptr)
        add_missing_target(target);
      else if (number->code == none)
        findings_.add(rules::EmptyTarget, line_, target.span,
                      fmt::format("line {} holds no statement and is dropped", target.value),
                      "jump to the line below it");
    }
  }

  void add_missing_target(const Item& target) {
    auto& d = findings_.add(rules::MissingTarget, line_, target.span,
                            fmt::format("there is no line {}", program_.text_of(target.span)));
    const auto next =
        std::lower_bound(flow_.numbers.begin(), flow_.numbers.end(), target.value,
                         [](const auto& row, std::uint32_t n) { return row.number < n; });
    if (next != flow_.numbers.end())
      d.help = fmt::format("the next one is {}", next->number);
    else if (!flow_.numbers.empty())
      d.help = fmt::format("the last one is {}", flow_.numbers.back().number);
  }

  void check_on(const StatementNode& statement) {
    check_targets(statement);
    const auto& [selector, targets] = program_.as<OnView>(statement);
    const auto count = static_cast<std::int32_t>(targets.size());
    const auto range = range_of(selector);
    if (range.misses(1, count))
      findings_.add(rules::SelectorRange, line_, selector.span,
                    fmt::format("the list has {} line{}, found {}", count, count == 1 ? "" : "s",
                                shown(range)));
  }

  void check_print(const StatementNode& statement) {
    std::uint64_t least = 0;
    std::uint64_t most = 0;
    const auto items = program_.items_of(statement);
    for (std::size_t i = 0; i < items.size(); ++i) {
      const auto& part = items[i];
      if (part.kind == ItemKind::String) {
        least += part.span.size() - 2;
        most += part.span.size() - 2;
      } else if (part.kind == ItemKind::Expression) {
        const auto digits = printed(range_of(part));
        least += digits.least;
        most += digits.most;
      } else if (part.kind == ItemKind::Semicolon) {
        if (i + 1 < items.size())
          add_semicolon(part, items[i + 1]);
      } else {
        ++least;
        ++most;
      }
    }
    const auto limit = static_cast<std::uint64_t>(spec::value_of(spec::Limit::PrintBytes));
    if (least > limit)
      findings_.add(rules::PrintTooLong, line_, statement.span,
                    fmt::format("the print takes at least {} bytes; {} are the most", least, limit),
                    "end the first part with `;` and print the rest on the next line");
    else if (most > limit)
      findings_.add(rules::PrintMayBeTooLong, line_, statement.span,
                    fmt::format("the print can take {} bytes; {} are the most", most, limit));
  }

  void add_semicolon(const Item& semicolon, const Item& next) {
    auto& d = findings_.add(rules::SemicolonInPrint, line_, semicolon.span,
                            "a `;` means something only at the end of a print",
                            "leave it out, or write `,` for a blank");
    // A blank keeps what stands on both sides apart; a minus sign would join them.
    if (program_.text[next.span.begin] != '-')
      d.fix = single_fix("write a blank", semicolon.span, " ");
  }

  void check_input(const StatementNode& statement) {
    forget(statement);
    read_flags_ = 0;
    if (const auto* milliseconds = program_.as<InputView>(statement).milliseconds)
      check_range(*milliseconds, spec::info(statement.kind).word,
                  spec::info(statement.kind).parameters()[0]);
  }

  void check_data(const StatementNode& statement) {
    const auto values = program_.items_of(statement);
    const auto count = static_cast<std::uint32_t>(values.size());
    const auto most = static_cast<std::uint32_t>(spec::value_of(spec::Limit::DataValues));
    if (count > most)
      findings_.add(rules::TooManyDataValues, line_, values[most].span,
                    fmt::format("the line holds {} values; the robot ignores those after the {}th",
                                count, most));
    for (const auto& value : values) {
      const auto& root = program_.nodes[value.value];
      const bool negative =
          root.kind == NodeKind::Negate && program_.nodes[value.value - 1].kind == NodeKind::Number;
      if (root.kind != NodeKind::Number && !negative) {
        findings_.add(rules::DataExpression, line_, value.span,
                      "a `data` value is a plain number in the documents");
        break;
      }
    }
    if (data_unread_ != none && !conditional_) {
      auto& d =
          findings_.add(rules::DataReplaced, line_, statement.word,
                        "these values replace those of the line before, which were never read",
                        "put all values on one line");
      d.notes.push_back({program_.statements[data_unread_].span, "the values that are lost"});
    }
    data_size_ = std::min(count, most);
    data_left_ = conditional_ ? unknown_data : data_size_;
    data_unread_ =
        conditional_ ? none : static_cast<std::uint32_t>(&statement - program_.statements.data());
  }

  void check_read(const StatementNode& statement) {
    forget(statement);
    data_unread_ = none;
    const auto count = program_.items_of(statement).size();
    if (count > 1)
      findings_.add(rules::ReadSeveral, line_, statement.span,
                    "some firmware reads one variable in a `read`",
                    "write one `read` for each variable");
    if (conditional_) {
      data_left_ = unknown_data;
      return;
    }
    if (data_left_ == unknown_data) {
      if (!has_data())
        findings_.add(rules::ReadPastData, line_, statement.span, "there is no `data` to read",
                      "add a `data` line above");
      return;
    }
    if (count > data_left_) {
      findings_.add(rules::ReadPastData, line_, statement.span,
                    fmt::format("{} value{} left in the data, {} read here", data_left_,
                                data_left_ == 1 ? " is" : "s are", count));
      data_left_ = unknown_data;
      return;
    }
    data_left_ -= static_cast<std::uint32_t>(count);
  }

  bool has_data() {
    if (!data_known_) {
      data_known_ = true;
      has_data_ = std::any_of(program_.statements.begin(), program_.statements.end(),
                              [](const StatementNode& statement) {
                                return statement.error || statement.kind == spec::Statement::Data;
                              });
    }
    return has_data_;
  }

  // ---- blanks

  void check_blanks(const StatementNode& statement) {
    if (statement.word.size() > 0 && statement.spelling != Spelling::QuestionMark)
      check_gap_after(statement.word.end, statement.span.end, spec::info(statement.kind).word);
    if (statement.kind == spec::Statement::For) {
      const auto loop = program_.as<ForView>(statement);
      check_gap(loop.start.span.end, loop.end.span.begin, "to");
      if (loop.step != nullptr)
        check_gap(loop.end.span.end, loop.step->span.begin, "step");
    } else if (statement.kind == spec::Statement::If) {
      const auto condition = program_.as<IfView>(statement);
      if (condition.second)
        check_gap(condition.first.right.span.end, condition.second->left.span.begin,
                  condition.joint->kind == ItemKind::And ? "and" : "or");
      // A branch without text has no side that a blank could stand on.
      const auto& then = program_.statements[statement.then_branch].span;
      if (then.size() > 0)
        check_gap(condition.last().right.span.end, then.begin, "then");
      if (then.size() > 0 && statement.else_branch != none &&
          program_.statements[statement.else_branch].span.size() > 0)
        check_gap(then.end, program_.statements[statement.else_branch].span.begin, "else");
    } else if (statement.kind == spec::Statement::On) {
      const auto& [selector, targets] = program_.as<OnView>(statement);
      check_gap(selector.span.end, targets.front().span.begin,
                statement.spelling == Spelling::OnGosub ? "gosub" : "goto");
    }
  }

  void check_gap_after(std::uint32_t at, std::uint32_t end, std::string_view word) {
    if (at < end && !is_blank(program_.text[at]))
      add_missing_blank(line_, at, fmt::format("`{}`", word));
  }

  /// A word stands between two expressions: blanks belong on both of its sides.
  void check_gap(std::uint32_t begin, std::uint32_t end, std::string_view word) {
    if (end <= begin)
      return;
    if (!is_blank(program_.text[begin]))
      add_missing_blank(line_, begin, fmt::format("`{}`", word));
    else if (!is_blank(program_.text[end - 1]))
      add_missing_blank(line_, end, fmt::format("`{}`", word));
  }

  // ---- expressions

  /// Goes through the nodes of a statement in the order in which they are computed.
  void evaluate(const StatementNode& statement) {
    const auto* step =
        statement.kind == spec::Statement::For ? program_.as<ForView>(statement).step : nullptr;
    for (const auto& part : program_.items_of(statement)) {
      if (part.kind != ItemKind::Expression && part.kind != ItemKind::Character)
        continue;
      const auto sign_allowed_at = &part == step ? part.span.begin : none;
      for (auto n = program_.nodes[part.value].first; n <= part.value; ++n)
        ranges_[n] = evaluate(n, sign_allowed_at);
    }
  }

  Range evaluate(std::uint32_t index, std::uint32_t sign_allowed_at) {
    const auto& node = program_.nodes[index];
    switch (node.kind) {
    case NodeKind::Number:
      if (node.overflow) {
        findings_.add(rules::LiteralTooLarge, line_, node.span,
                      fmt::format("{} is above {}", program_.text_of(node.span),
                                  spec::value_of(spec::Limit::GreatestInteger)));
        return {};
      }
      return Range::only(node.value);
    case NodeKind::Letter: {
      auto& letter = letters_[node.what];
      if (letter.first_used == none) {
        letter.first_used = index;
        letter.used_line = line_;
      }
      return value_of_letter(node.what);
    }
    case NodeKind::Indexed: check_index(node.span); return {};
    case NodeKind::System: return read_system(node);
    case NodeKind::Group: check_depth(node); return ranges_[index - 1];
    case NodeKind::Negate:
      if (node.span.begin != sign_allowed_at)
        add_negative(node);
      return negate(ranges_[index - 1]);
    case NodeKind::Binary: return evaluate_binary(node, index);
    case NodeKind::Call: return evaluate_call(node, index);
    }
    return {};
  }

  void check_depth(const Node& node) {
    const auto most = spec::value_of(spec::Limit::ExpressionLevels);
    if (node.depth == most + 1)
      findings_.add(rules::ExpressionLevels, line_, node.span,
                    fmt::format("more than {} parentheses and functions are open at once", most),
                    "compute a part of it on a line of its own");
  }

  void add_negative(const Node& node) {
    auto& d = findings_.add(rules::NegativeLiteral, line_, node.span,
                            "negative numbers are not documented", "write `0-…`");
    const auto version = target_.version;
    if (version == spec::BasicVersion::V0_9)
      d.severity = Severity::Error;
    // Behind an operator, or before one that binds more strongly than minus, only parentheses keep
    // the sign with its operand.
    auto before = node.span.begin;
    while (before > 0 && is_blank(program_.text[before - 1]))
      --before;
    auto after = node.span.end;
    while (after < program_.text.size() && is_blank(program_.text[after]))
      ++after;
    const bool bound = before > 0 && spec::find_operator(program_.text[before - 1]);
    const auto next = after < program_.text.size() ? spec::find_operator(program_.text[after])
                                                   : std::optional<spec::Operator>();
    const bool binds = next && spec::info(*next).level == spec::Level::Medium;
    const auto begin = node.span.begin;
    if (!bound && !binds) {
      d.help = fmt::format("write `0{}`", program_.text_of(node.span));
      d.fix = single_fix(d.help, {begin, begin}, "0");
      return;
    }
    d.help = fmt::format("write `(0{})`", program_.text_of(node.span));
    // Each function around it may get parentheses in the same round, which also count.
    if (2 * node.depth + 1 + deepest_below(node) <= spec::value_of(spec::Limit::ExpressionLevels))
      d.fix = Fix{
          d.help, {{{begin, begin}, "(0"}, {{node.span.end, node.span.end}, ")"}}, Safety::Safe};
  }

  Range read_system(const Node& node) {
    const auto& row = spec::variables[node.what];
    const bool old_name = !row.old_word.empty() && program_.text_of(node.span) == row.old_word;
    if (old_name && target_.version >= row.since) {
      auto& d = findings_.add(rules::OldName, line_, node.span,
                              fmt::format("`{}` is called `{}` since orbBasic {}", row.old_word,
                                          row.word, spec::info(row.since).text),
                              fmt::format("write `{}`", row.word));
      d.fix = single_fix(d.help, node.span, std::string(row.word));
    } else if (!old_name && row.since > target_.version) {
      add_newer(node.span, row.word, row.since);
      if (!row.old_word.empty())
        findings_.all().back().help = fmt::format("it was called `{}` then", row.old_word);
    }
    if (row.access == spec::Access::ReadClears)
      note_clearing(node, row);
    return {row.least, row.greatest};
  }

  void note_clearing(const Node& node, const spec::VariableInfo& row) {
    std::uint32_t slot = 0; // few variables clear themselves; their order is their slot
    for (const auto& other : spec::variables) {
      if (other.variable == row.variable)
        break;
      slot += other.access == spec::Access::ReadClears ? 1 : 0;
    }
    if (((line_reads_ | read_flags_) & bit(slot)) != 0)
      findings_.add(
          rules::ClearedByReading, line_, node.span,
          fmt::format("`{}` is read again, but the reading before has set it to 0", row.word),
          "copy it into a variable and use that");
    line_reads_ |= bit(slot);
    if (!conditional_)
      read_flags_ |= bit(slot);
  }

  Range evaluate_binary(const Node& node, std::uint32_t index) {
    const auto op = static_cast<spec::Operator>(node.what);
    const auto right_index = index - 1;
    const auto right = ranges_[right_index];
    const auto left = ranges_[program_.nodes[right_index].first - 1];
    const auto& right_span = program_.nodes[right_index].span;
    const bool divides = op == spec::Operator::Divide || op == spec::Operator::Remainder;
    const bool shifts = op == spec::Operator::ShiftLeft || op == spec::Operator::ShiftRight;
    if (divides && right == Range::only(0)) {
      findings_.add(rules::DivisionByZero, line_, right_span, "the divisor is 0");
      return {};
    }
    const auto most = spec::value_of(spec::Limit::GreatestShift);
    if (shifts && right.misses(0, most)) {
      findings_.add(rules::ValueOutOfRange, line_, right_span,
                    fmt::format("a shift is by 0 to {} bits, found {}", most, shown(right)));
      return {};
    }
    return apply(op, left, right);
  }

  Range evaluate_call(const Node& node, std::uint32_t index) {
    check_depth(node);
    const auto& row = spec::functions[node.what];
    const auto& operand = program_.nodes[index - 1];
    const auto range = ranges_[index - 1];
    if (range.misses(row.least, row.greatest)) {
      findings_.add(
          rules::ValueOutOfRange, line_, operand.span,
          fmt::format("`{}` takes {} or more, found {}", row.word, row.least, shown(range)));
      return {};
    }
    check_operand(node, operand, row);
    return apply(row.function, range);
  }

  /// the operand is the whole expression that follows, which reads otherwise where a weak
  /// operator follows, or anything behind a parenthesis.
  void check_operand(const Node& node, const Node& operand, const spec::FunctionInfo& row) {
    if (operand.kind != NodeKind::Binary)
      return;
    const auto& op = spec::operators[operand.what];
    const bool parenthesis = program_.text[operand.span.begin] == '(';
    if (op.level != spec::Level::Low && !parenthesis)
      return;
    auto& d = findings_.add(
        rules::FunctionOperand, line_, node.span,
        fmt::format("`{}` takes all of `{}`", row.word, program_.text_of(operand.span)),
        fmt::format("write `{} ({})`, or `({} …)` for less", row.word,
                    program_.text_of(operand.span), row.word));
    // Other fixes of the same round may put parentheses around and into this operand.
    const int levels = node.depth + 1 + (node.depth - 1) + deepest_below(operand);
    if (levels <= spec::value_of(spec::Limit::ExpressionLevels))
      d.fix = Fix{"put the operand into parentheses",
                  {{{operand.span.begin, operand.span.begin},
                    program_.text[operand.span.begin - 1] == ' ' ? "(" : " ("},
                   {{operand.span.end, operand.span.end}, ")"}},
                  Safety::Safe};
  }

  /// How many levels a subtree has, and at most can get by fixes: functions and signs count twice.
  int deepest_below(const Node& root) const {
    int levels = 0;
    const auto index = static_cast<std::uint32_t>(&root - program_.nodes.data());
    for (auto i = root.first; i < index; ++i) {
      const auto kind = program_.nodes[i].kind;
      levels += kind == NodeKind::Group || kind == NodeKind::Negate ? 1 : 0;
      levels += kind == NodeKind::Call ? 2 : 0;
    }
    return levels;
  }

  static constexpr std::uint32_t unknown_data = none;

  const Program& program_;
  const Target& target_;
  Findings findings_;
  Flow flow_;
  std::vector<std::uint32_t> targets_;
  bool targets_sorted_ = false;
  std::array<Letter, letters> letters_{};
  std::vector<Range> ranges_;

  // what is known on the way through a block
  std::array<Range, letters> values_{};
  std::array<std::uint32_t, letters> stamps_{};
  std::uint32_t block_ = 0;
  std::uint32_t line_ = 0;
  std::uint32_t blank_line_ = none;
  std::uint32_t data_size_ = unknown_data;
  std::uint32_t data_left_ = unknown_data;
  std::uint32_t data_unread_ = none;
  std::uint32_t read_flags_ = 0;
  std::uint32_t line_reads_ = 0;
  bool conditional_ = false;
  bool indexed_used_ = false;
  bool before_y_ = false;
  bool data_known_ = false;
  bool has_data_ = false;
};

} // namespace

std::int32_t area_bytes(const Target& target) {
  if (target.area == Area::Flash)
    return spec::value_of(spec::Limit::FlashBytes);
  if (target.ram_bytes)
    return *target.ram_bytes;
  return spec::value_of(target.version == spec::BasicVersion::V0_9 ? spec::Limit::RamBytesUntil146
                                                                   : spec::Limit::RamBytes);
}

std::vector<Diagnostic> lint(const Program& program, const Target& target) {
  return Linter(program, target).run();
}

} // namespace orb::compiler
