#include "compiler/lint/usual_values.h"

#include "compiler/analyse/letter_flow.h"
#include "compiler/analyse/reading.h"

#include <algorithm>

namespace orb::compiler {
namespace {

/// A timer counts down from the number that it is set to, or up.
std::optional<Range> usual_time(const Program& program, const Flow& flow, std::size_t timer) {
  std::optional<std::int32_t> start;
  for (const auto& place : flow.all(spec::Statement::Let)) {
    const auto let = program.as<LetView>(program.statements[place.statement]);
    if (let.variable.kind != ItemKind::System || let.variable.value != timer)
      continue;
    const auto number = number_in(program, let.expression);
    if (!number || start.value_or(*number) != *number)
      return std::nullopt; // it is unknown from which number it counts
    start = number;
  }
  constexpr int second = 1000; // ms
  return Range{0, start.value_or(0) == 0 ? second : *start};
}

std::optional<Range> usual_values_of(const Program& program, const Flow& flow, std::size_t sensor) {
  const auto& row = spec::variables[sensor];
  if (row.unit == "cm")
    return Range{-100, 100}; // a room
  if (row.unit == "ms")
    return usual_time(program, flow, sensor);
  if (row.variable == spec::Variable::Accelone)
    return Range{0, 2000}; // 0.001 g; 1000 at rest
  if (row.variable == spec::Variable::Vbatt)
    return Range{700, 800}; // 0.01 V
  return std::nullopt;
}

/// True if the program compares a sensor, or what it computes from it.
bool is_compared(const Program& program, const Flow& flow, std::size_t sensor) {
  LetterSet computed = 0;
  const auto reads = [&](const Item& expression) {
    const auto nodes = nodes_of(program, expression);
    return std::any_of(nodes.begin(), nodes.end(), [&](const Node& node) {
      return (node.kind == NodeKind::System && node.what == sensor) ||
             (node.kind == NodeKind::Letter && (computed & bit(node.what)) != 0);
    });
  };
  for (LetterSet before = ~computed; before != computed;) {
    before = computed;
    for (const auto& place : flow.all(spec::Statement::Let)) {
      const auto let = program.as<LetView>(program.statements[place.statement]);
      if (let.variable.kind == ItemKind::Letter && reads(let.expression))
        computed |= bit(let.variable.value);
    }
  }
  const auto bounds = [&](const Comparison& comparison) {
    const auto test = sensor_test(program, comparison);
    const bool waits = test && test->number == 0 && spec::info(test->sensor).unit == "ms";
    return !waits && (reads(comparison.left) || reads(comparison.right));
  };
  const auto& all = flow.all(spec::Statement::If);
  return std::any_of(all.begin(), all.end(), [&](const Flow::Place& place) {
    const auto condition = program.as<IfView>(program.statements[place.statement]);
    return bounds(condition.first) || (condition.second && bounds(*condition.second));
  });
}

} // namespace

UsualValues usual_values(const Program& program, const Flow& flow) {
  UsualValues usual;
  for (const auto& node : program.nodes)
    if (node.kind == NodeKind::System && !usual[node.what])
      usual[node.what] = usual_values_of(program, flow, node.what);
  for (std::size_t sensor = 0; sensor < usual.size(); ++sensor)
    if (usual[sensor] && is_compared(program, flow, sensor))
      usual[sensor].reset();
  return usual;
}

} // namespace orb::compiler
