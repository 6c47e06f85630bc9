#include "cli/run/run_robots.h"

#include "cli/input/inputs.h"
#include "cli/many/many.h"
#include "cli/run/run_options.h"

#include <fmt/format.h>
#include <optional>

namespace orb::cli {
namespace {

/// Why these options allow a single robot only; empty if several can run.
std::string_view for_one_robot(const RunOptions& options) {
  return options.open || options.report == "-"
             ? "`--open` and `--report -` show only one robot; with several, use `--report "
               "OUT.html`, which writes a page for each"
         : !options.trace.empty() && options.trace_out.empty()
             ? "a trace covers only one robot; with several, use `--trace-out FILE`, which writes "
               "a file for each"
         : !options.compare.empty()    ? "`--compare` shows only one robot; with several, omit it"
         : options.input == from_stdin ? "typed numbers go to only one robot; with several, put "
                                         "them on the command line, as in `--input 1,2`"
                                       : "";
}

/// Reports what would be wrong for every robot.
tl::expected<void, Failure> check_for_several(const Context& context, const RunOptions& options) {
  if (const auto why = for_one_robot(options); !why.empty())
    return tl::unexpected(Failure{ExitCode::Usage, std::string(why)});
  const auto read = read_options(context, options);
  if (!read)
    return tl::unexpected(read.error());
  const auto inputs = read_inputs(options.files, options.language, read->target);
  if (!inputs)
    return tl::unexpected(inputs.error());
  return check_inputs(context, *inputs);
}

/// Why one of several robots cannot run the program.
std::optional<std::string> robot_misfit(const RunOptions& options, const RosterMember& robot) {
  if (!robot.robot || options.robot.empty() || spec::info(*robot.robot).name == options.robot)
    return std::nullopt;
  return fmt::format("is a {}, not a {}; omit `--robot {}`", spec::info(*robot.robot).title,
                     spec::find_robot(options.robot)->title, options.robot);
}

} // namespace

void run_on_robots(Context& context, const RunOptions& options,
                   const std::function<void(Context&, RunOptions&)>& run_one) {
  ManyOptions many;
  many.command = "run";
  many.jobs = all_at_once;
  many.check = [&] { return check_for_several(context, options); };
  many.misfit = [&](const RosterMember& robot) { return robot_misfit(options, robot); };
  with_robots(context, options.roster, many,
              [&](Context& own, const RosterMember& robot, Row* row) {
                auto one = options;
                one.port.port = robot.port;
                if (row != nullptr)
                  for (auto* file : {&one.record, &one.report, &one.svg, &one.trace_out})
                    *file = file_of(*file, robot);
                run_one(own, one);
              });
}

} // namespace orb::cli
