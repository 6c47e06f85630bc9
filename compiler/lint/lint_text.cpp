#include "compiler/lint/line_pass.h"
#include "compiler/text/rules.h"
#include "spec/limits.h"

#include <algorithm>
#include <fmt/format.h>
#include <optional>

namespace orb::compiler {
namespace {

/// True if the character is neither printable ASCII nor LF.
constexpr bool is_unusual(char c) {
  return ((c < ' ') | (c > '~')) & (c != '\n');
}

bool has_unusual_byte(std::string_view text) {
  constexpr std::size_t block = 64; // a constant, so that the compiler vectorizes the loop
  for (; text.size() >= block; text.remove_prefix(block)) {
    std::uint8_t found = 0;
    for (std::size_t i = 0; i < block; ++i)
      found |= static_cast<std::uint8_t>(is_unusual(text[i]));
    if (found != 0)
      return true;
  }
  return std::any_of(text.begin(), text.end(), is_unusual);
}

/// Checks the bytes of a text and the order of its line numbers.
class TextPass : private LinePass {
public:
  using LinePass::LinePass;

  void run() {
    check_bytes();
    check_numbers();
  }

private:
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
      } else if ((c < ' ' || c >= '\x7F') && (c != '\t' || in_string) && !byte_seen) {
        byte_seen = true;
        findings_.add(rules::NonprintingByte, {i, i + 1},
                      texts::ByteNotPrintable(fmt::format("{:02X}", c)),
                      texts::WritePlainLetters());
      }
    }
  }

  void add_tab(std::uint32_t index, std::uint32_t first, std::uint32_t end) {
    auto& d =
        findings_.add(rules::Tab, {first, first + 1}, texts::TabForSpace(), texts::WriteSpace());
    Fix fix{texts::WriteSpaces(), {}, Safety::Safe};
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
    auto& d = findings_.add(rules::LineEnding, {begin, begin},
                            texts::LinesEndIn(pair ? "CRLF" : "CR"), texts::RobotRequiresLf());
    Fix fix{texts::EndLinesInLf(), {}, Safety::Safe};
    for (auto i = begin; i < program_.text.size(); ++i)
      if (program_.text[i] == '\r') {
        const bool followed = i + 1 < program_.text.size() && program_.text[i + 1] == '\n';
        fix.edits.push_back({{i, i + 1}, followed ? "" : "\n"});
      }
    d.fix = std::move(fix);
  }

  void check_numbers() {
    if (flow_.orderly)
      return;
    std::uint32_t last = 0;
    bool ascending = true;
    for (std::uint32_t i = 0; i < program_.lines.size(); ++i) {
      const auto& line = program_.lines[i];
      if (!line.has_number())
        continue;
      if (line.number == 0)
        findings_.add(rules::LineNumberRange, line.number_span,
                      texts::LineNumberZero(spec::value_of(spec::Limit::LeastLineNumber),
                                            spec::value_of(spec::Limit::GreatestLineNumber)));
      if (line.number <= last && i > 0)
        ascending = false;
      if (line.number < last && !flow_.is_taken(line.number, i)) // duplicate-line reports it
        findings_.add(rules::UnsortedLines, line.number_span, texts::LineIsBelow(line.number, last),
                      texts::LinesRunInOrder());
      last = line.number;
      if (!line.has_statement())
        add_empty_line(line);
    }
    if (!ascending)
      check_duplicates();
  }

  void add_empty_line(const Line& line) {
    auto& d = findings_.add(rules::LineWithoutStatement, line.number_span,
                            texts::HasNoStatement(line.number),
                            line.comment.size() > 0 ? texts::CommentNeedsNoNumber() : Message());
    if (line.number == none - 1 || is_target(line.number))
      return;
    if (line.comment.size() > 0)
      d.fix = single_fix(texts::RemoveNumber(), {line.span.begin, line.comment.begin}, "");
  }

  /// True if a jump names the line. The first call sorts the jumps.
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
    constexpr std::size_t most_fixes = 64; // the rest follows once these are applied
    std::size_t first = 0;
    std::size_t found = 0;
    for (std::size_t i = 1; i < flow_.numbers.size(); ++i) {
      const auto& row = flow_.numbers[i];
      if (row.number != flow_.numbers[first].number) {
        first = i;
        continue;
      }
      const auto& line = program_.lines[row.line];
      auto& d =
          findings_.add(rules::DuplicateLine, line.number_span, texts::LineNumberTaken(row.number));
      const auto& original = program_.lines[flow_.numbers[first].line];
      add_note(d, original.number_span, texts::FirstWithThatNumber());
      if (++found > most_fixes)
        continue;
      if (const auto free = free_number(row.line)) {
        offered_.push_back(*free);
        d.fix = single_fix(texts::RenumberTo(*free), line.number_span, std::to_string(*free));
      }
    }
  }

  /// A number between those of the neighbours that no line or jump uses.
  std::optional<std::uint32_t> free_number(std::uint32_t index) {
    std::uint32_t below = 0;
    for (std::uint32_t i = 0; i <= index; ++i)
      if (program_.lines[i].has_number())
        below = std::max(below, program_.lines[i].number);
    auto above = static_cast<std::uint32_t>(spec::value_of(spec::Limit::GreatestLineNumber)) + 1;
    for (auto i = index + 1; i < program_.lines.size(); ++i)
      if (program_.lines[i].has_number() && program_.lines[i].number > below) {
        above = program_.lines[i].number;
        break;
      }
    const auto is_free = [&](std::uint32_t n) {
      return flow_.find(n) == nullptr && !is_target(n) &&
             std::find(offered_.begin(), offered_.end(), n) == offered_.end();
    };
    constexpr std::uint32_t tries = 100; // a denser text should be renumbered instead
    const auto middle = above - below > 20 ? below + 10 : below + (above - below) / 2;
    for (std::uint32_t n = middle; n < above && n < middle + tries; ++n)
      if (n > below && is_free(n))
        return n;
    for (std::uint32_t n = below + 1; n < middle && n < below + tries; ++n)
      if (is_free(n))
        return n;
    return std::nullopt;
  }

  std::vector<std::uint32_t> targets_; ///< line numbers named by jumps, ascending
  bool targets_sorted_ = false;
  std::vector<std::uint32_t> offered_; ///< numbers offered for lines with duplicate numbers
};

} // namespace

void lint_text(const Program& program, const Flow& flow, Findings& findings) {
  TextPass(program, flow, findings).run();
}

} // namespace orb::compiler
