#include "cli/input/target.h"

#include "cli/model/command.h"
#include "spec/limits.h"

#include <fmt/format.h>
#include <vector>

namespace orb::cli {
namespace {

std::vector<std::string> versions() {
  std::vector<std::string> all;
  for (const auto& row : spec::basic_versions)
    all.emplace_back(row.text);
  return all;
}

std::vector<std::string> ram_sizes() {
  std::vector<std::string> all;
  for (const auto limit :
       {spec::Limit::RamBytesUntil146, spec::Limit::RamBytesUntil147, spec::Limit::RamBytes})
    all.push_back(std::to_string(spec::value_of(limit)));
  return all;
}

} // namespace

compiler::Target TargetOptions::target() const {
  compiler::Target target;
  if (const auto found = spec::find_version(version))
    target.version = *found;
  if (area == "flash")
    target.area = spec::Area::Flash;
  if (ram != 0)
    target.ram_bytes = ram;
  return target;
}

void add_target_options(const Command& command, TargetOptions& options) {
  command
      .add_option("--target", options.version,
                  fmt::format("the robot's orbBasic version ({})",
                              spec::info(spec::default_basic_version).text))
      .check(one_of(versions()))
      .environment("ORB_TARGET");
  command.add_option("--ram", options.ram, "size of the robot's RAM area in bytes")
      .check(one_of(ram_sizes()));
  command.add_option("--area", options.area, "the area that the program is stored in")
      .check(one_of({"ram", "flash"}))
      .show_default();
}

} // namespace orb::cli
