#include "structured/lift/choices.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace orb::structured::lifting {

const compiler::Item& LiftedChoices::selector(std::uint32_t step) const {
  return program_.as<compiler::OnView>(statement_of(program_, ways_, step)).selector;
}

/// If an `on` may find no line, its value is used again, so an expression must be kept in a
/// variable.
bool LiftedChoices::needs_helper(std::uint32_t step) const {
  return !covered_[step] && program_.nodes[selector(step).value].kind != compiler::NodeKind::Letter;
}

std::string LiftedChoices::chosen(std::uint32_t step) {
  if (!needs_helper(step))
    return values_.text(selector(step));
  auto& name = helpers_[step];
  if (name.empty())
    name = names_.fresh("choice");
  return name;
}

std::vector<std::string> LiftedChoices::begin(std::uint32_t step) {
  std::vector<std::string> lines;
  if (needs_helper(step))
    lines.push_back(fmt::format("{} = {}", chosen(step), values_.text(selector(step))));
  lines.push_back(fmt::format("select {}", chosen(step)));
  return lines;
}

std::vector<std::string> LiftedChoices::end(std::uint32_t step) {
  if (covered_[step])
    return {"end select"};
  stops_.push_back(step);
  values_.use_elements();
  return {"else",
          fmt::format("{}{})] = 0 ' the robot stops here: {}", stopper, chosen(step),
                      spec::info(spec::BasicError::IllegalIndex).text),
          "end select"};
}

std::vector<std::string> LiftedChoices::calls(std::uint32_t step) {
  auto lines = begin(step);
  const auto& targets = ways_.steps[step].targets;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    if (std::find(targets.begin(), targets.begin() + static_cast<std::ptrdiff_t>(i), targets[i]) !=
        targets.begin() + static_cast<std::ptrdiff_t>(i))
      continue; // merged with an earlier one
    std::vector<std::size_t> values;
    for (std::size_t n = i; n < targets.size(); ++n)
      if (targets[n] == targets[i])
        values.push_back(n + 1);
    lines.push_back(fmt::format("case {}", fmt::join(values, ", ")));
    lines.push_back(sub_at(ways_, names_, targets[i]));
  }
  for (auto& text : end(step))
    lines.push_back(std::move(text));
  return lines;
}

const std::string& sub_at(const ControlFlow& ways, const LiftedNames& names, std::uint32_t step) {
  const auto& subs = ways.subroutines;
  return names.sub(
      static_cast<std::size_t>(std::lower_bound(subs.begin(), subs.end(), step) - subs.begin()));
}

} // namespace orb::structured::lifting
