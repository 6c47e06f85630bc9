#include "compiler/lint/lint.h"

#include "base/silence.h"
#include "compiler/lint/lint_passes.h"
#include "compiler/messages/messages.h"
#include "compiler/text/image.h"
#include "compiler/text/rules.h"
#include "spec/limits.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>
#include <map>

namespace orb::compiler {
namespace {

/// The line with byte `room` of the image, the first that does not fit.
std::uint32_t line_at_byte(const Program& program, const Flow& flow, std::int32_t room) {
  std::int32_t size = 1;
  for (const auto& code : flow.code) {
    size += static_cast<std::int32_t>(image_size(program, code.line));
    if (size > room)
      return code.line;
  }
  return flow.code.back().line;
}

void check_size(const Program& program, const Flow& flow, const Target& target,
                Findings& findings) {
  if (flow.code.empty())
    return;
  const auto room = area_bytes(target);
  const auto oldest = spec::value_of(spec::Limit::RamBytesUntil146);
  const bool in_ram = target.area == Area::Ram;
  const bool may_be_old = in_ram && !target.ram_bytes;
  // The image adds at most a space and a line ending per line.
  const auto most = static_cast<std::int32_t>(program.text.size() + 2 * program.lines.size());
  if (most < (may_be_old ? std::min(room, oldest) : room))
    return;
  const auto size = static_cast<std::int32_t>(image_size(program));
  if (size > room) {
    const auto line = line_at_byte(program, flow, room);
    findings.add(rules::ProgramTooLarge, program.lines[line].span,
                 texts::MoreThanAreaHolds(size, size - room, room, in_ram ? "RAM" : "flash"),
                 texts::PackMakesSmaller());
  } else if (may_be_old && size > oldest) {
    const auto line = line_at_byte(program, flow, oldest);
    findings.add(rules::LargerThanOldRam, program.lines[line].span,
                 texts::MoreThanOldRobotsHold(size, oldest),
                 texts::GiveRam(spec::value_of(spec::Limit::RamBytes)));
  }
}

/// The line including its line ending.
Span with_end(Span line) {
  return {line.begin, line.end + 1};
}

/// Removes the findings allowed by a comment `' orb: allow RULE` on the same line, or on the line
/// above if it is alone there.
void silence(const Program& program, Findings& findings) {
  std::vector<AllowComment> comments;
  for (std::size_t i = 0; i < program.lines.size(); ++i) {
    const auto& line = program.lines[i];
    if (line.comment.size() == 0 ||
        program.text_of(line.comment).find(allow_mark) == std::string_view::npos)
      continue;
    const bool alone = !line.has_number() && !line.has_statement();
    const auto about = alone ? i + 1 : i;
    comments.push_back({line.comment, about < program.lines.size()
                                          ? with_end(program.lines[about].span)
                                          : Span{}});
  }
  if (!comments.empty())
    orb::silence(program.text, comments, rules::all(), rules::UnknownRule, findings.all());
}

/// Drops a warning where an error begins, and one about a byte inside an unknown word: it has the
/// same cause and says less.
void drop_doubles(std::vector<Diagnostic>& findings) {
  std::map<std::uint32_t, std::uint32_t> errors; // from begin to end
  for (const auto& d : findings)
    if (d.severity == Severity::Error)
      errors.emplace(d.span.begin,
                     d.rule == &rules::UnknownStatement ? d.span.end : d.span.begin + 1);
  std::erase_if(findings, [&](const Diagnostic& d) {
    const auto above = errors.upper_bound(d.span.begin);
    if (d.severity == Severity::Error || above == errors.begin())
      return false;
    const auto [begin, end] = *std::prev(above);
    return (d.rule == &rules::NegativeLiteral && d.span.begin == begin) ||
           (d.rule == &rules::NonprintingByte && d.span.begin < end);
  });
}

/// Adds the line number to each finding, except for line endings, which concern the whole file.
void place(const Program& program, std::vector<Diagnostic>& findings) {
  for (auto& d : findings) {
    const auto next = std::upper_bound(
        program.lines.begin(), program.lines.end(), d.span.begin,
        [](std::uint32_t offset, const Line& line) { return offset < line.span.begin; });
    if (next != program.lines.begin() && next[-1].has_number() && d.rule != &rules::LineEnding)
      d.basic_line = next[-1].number;
  }
}

/// Runs the passes that need to know all jumps, but those about values.
void lint_ways(const Program& program, const Flow& flow, Findings& findings) {
  lint_flow(program, flow, findings);
  lint_effects(program, flow, findings);
  lint_units(program, flow, findings);
  const auto settings = read_settings(program, flow);
  lint_waits(program, flow, settings, findings);
  lint_meant(program, flow, settings, findings);
  lint_updates(program, flow, settings, findings);
  lint_sums(program, flow, findings);
}

} // namespace

void add_note(Diagnostic& diagnostic, Span where, Message what) {
  diagnostic.notes.push_back({where, std::move(what)});
}

std::string stepped(const Program& program, std::string_view name, char sign, std::int64_t step) {
  return program.letters > spec::letter_count ? fmt::format("{} {}= {}", name, sign, step)
                                              : fmt::format("{0} = {0} {1} {2}", name, sign, step);
}

std::int32_t area_bytes(const Target& target) {
  if (target.area == Area::Flash)
    return spec::value_of(spec::Limit::FlashBytes);
  if (target.ram_bytes)
    return *target.ram_bytes;
  return spec::value_of(spec::info(target.version).ram);
}

std::vector<Diagnostic> lint(const Program& program, const Target& target) {
  Findings findings;
  const auto flow = read_flow(program);
  std::vector<const Fault*> unnumbered;
  for (const auto& fault : program.faults)
    if (auto diagnostic = explain(program, fault))
      findings.add(std::move(*diagnostic));
    else
      unnumbered.push_back(&fault);
  lint_missing_numbers(program, unnumbered, findings);
  const bool jumps_known =
      std::none_of(program.faults.begin(), program.faults.end(),
                   [&](const Fault& fault) { return may_steer(program, fault); });
  lint_text(program, flow, findings);
  lint_statements(program, flow, target, findings);
  lint_age(program, target, findings);
  const bool at_risk =
      lint_values(program, flow, target, jumps_known ? Jumps::Known : Jumps::Unknown, findings);
  if (jumps_known) {
    lint_loops(program, flow, findings);
    lint_ways(program, flow, findings);
    if (at_risk)
      lint_certain(program, flow, findings);
  }
  if (target.robot)
    lint_robot(program, *target.robot, findings);
  check_size(program, flow, target, findings);
  drop_doubles(findings.all());
  silence(program, findings);
  auto all = std::move(findings.all());
  place(program, all);
  sort_by_place(all);
  return all;
}

std::vector<Diagnostic> lint_meaning(const Program& program, const Target& target) {
  Findings findings;
  const auto flow = read_flow(program);
  lint_age(program, target, findings);
  const bool at_risk = lint_values(program, flow, target, Jumps::Known, findings);
  lint_ways(program, flow, findings);
  if (at_risk)
    lint_certain(program, flow, findings);
  if (target.robot)
    lint_robot(program, *target.robot, findings);
  sort_by_place(findings.all());
  return std::move(findings.all());
}

} // namespace orb::compiler
