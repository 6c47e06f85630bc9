#include "run/trace.h"

#include <fmt/format.h>
#include <string>
#include <utility>
#include <vector>

namespace orb::run {
namespace {

/// Source places of the robot's lines, if the source has no numbers.
report::LinePlaces places(std::span<const Input> inputs) {
  report::LinePlaces places;
  const auto* first = first_with_program(inputs);
  if (first != nullptr && first->program->compiled)
    for (const auto& entry : first->program->lines.places)
      places.emplace(static_cast<int>(entry.first), first->program->lines.words(entry.first));
  return places;
}

} // namespace

Trace::Trace(report::TraceFormat format, report::TraceLines lines, std::span<const Input> inputs,
             std::function<void(std::string_view)> put, report::TraceOf of)
    : writer_(format, lines, std::move(put), places(inputs), std::move(of)) {}

void Trace::add(Duration t, const ProgramError& fault) {
  const auto& cause = fault.cause;
  std::vector<report::TraceField> fields{{"line", std::int64_t{fault.robot_line}},
                                         {"code", std::int64_t{spec::code(fault.code)}},
                                         {"message", std::string(spec::info(fault.code).text)}};
  if (!cause.seen.empty())
    fields.push_back({"detail", cause.variables.empty()
                                    ? cause.seen
                                    : fmt::format("{}; {}", cause.seen, cause.variables)});
  if (!cause.parameter.empty())
    fields.push_back({"parameter", cause.parameter});
  for (const auto& [key, value] :
       {std::pair{"value", cause.value}, {"least", cause.least}, {"greatest", cause.greatest}})
    if (value)
      fields.push_back({key, *value});
  writer_.add(t, "error", fields);
}

void Trace::finish(const Ending& ending) {
  writer_.finish(ending.lasted, to_string(ending.reason), ending.lines);
}

} // namespace orb::run
