#include "cli/many/roster.h"

#include "base/refuse.h"
#include "base/text/text.h"
#include "cli/model/checks.h"
#include "cli/model/command.h"
#include "disk/disk.h"
#include "uploader/device_words.h"
#include "uploader/endpoint.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <map>

namespace orb::cli {
namespace {

constexpr int most_at_once = 1000;
constexpr int most_tries = 1000;

void add_rest(const Command& command, RosterOptions& options, const std::string& jobs) {
  command
      .add_option("--ports", options.file,
                  "a file of robots (`[balls]`, `[groups]`): all of them, or those named by --port")
      .type_name("FILE");
  command.add_option("--jobs", options.jobs, "how many robots at a time")
      .check(whole_number(1, most_at_once))
      .type_name("N")
      .show_default(jobs);
  command
      .add_option("--tries", options.tries, "how many times to try a robot that cannot be reached")
      .check(whole_number(1, most_tries))
      .type_name("N")
      .show_default();
}

/// Collects the robots named on the command line.
class Naming {
public:
  explicit Naming(Roster& roster) : roster_(roster) {}

  /// Adds `@red`, `@front` or a URL. `place` is its place in a file, empty for the command line.
  tl::expected<void, Failure> add(const std::string& port, const std::string& place) {
    if (!port.starts_with("@"))
      return add_member({port, port, "", {}});
    const auto name = port.substr(1);
    const auto& config = roster_.config;
    if (const auto group = config.groups.find(name); group != config.groups.end())
      return add_group(name, group->second);
    const auto ball = config.balls.find(name);
    if (ball == config.balls.end())
      return refuse(ExitCode::Usage, place + unknown(name));
    return add_member({name, port, place.empty() ? ball->second.place + ": " : place, {}});
  }

  tl::expected<void, Failure> check_group(const std::string& name, const Group& group) const {
    if (roster_.config.balls.contains(name))
      return refuse(
          ExitCode::Usage,
          fmt::format("{}: `{}` is already the name of a ball; give the group another name",
                      group.place, name));
    for (const auto& member : group.members)
      if (!roster_.config.balls.contains(member.name))
        return refuse(ExitCode::Usage, fmt::format("{}: {}", member.place, unknown(member.name)));
    return {};
  }

private:
  std::string unknown(const std::string& name) const {
    auto names = names_in(roster_.config.balls);
    for (auto& group : names_in(roster_.config.groups))
      names.push_back(std::move(group));
    return unknown_ball(name, names);
  }

  tl::expected<void, Failure> add_group(const std::string& name, const Group& group) {
    if (auto good = check_group(name, group); !good)
      return good;
    for (const auto& member : group.members)
      if (auto added = add("@" + member.name, member.place + ": "); !added)
        return added;
    return {};
  }

  tl::expected<void, Failure> add_member(RosterMember member) {
    const auto endpoint = find_endpoint(roster_.config, member.port);
    if (!endpoint)
      return refuse(ExitCode::Usage, member.place + endpoint.error().message);
    member.robot = named_robot(roster_.config, member.port);
    if (endpoint->scheme == uploader::Scheme::Sim)
      return add_virtual(std::move(member));
    const auto where = same_where(*endpoint);
    if (const auto [other, is_new] = known_.emplace(where, member.name); !is_new)
      return refuse(
          ExitCode::Usage,
          other->second == member.name
              ? fmt::format("{}duplicate `{}`; give it only once", member.place, member.port)
              : fmt::format("{}`{}` and `{}` are the same robot, {}; omit one of them",
                            member.place, other->second, member.name, endpoint->text));
    roster_.members.push_back(std::move(member));
    return {};
  }

  /// Each `sim:` is a separate ball.
  tl::expected<void, Failure> add_virtual(RosterMember member) {
    const auto taken = [&](const std::string& name) {
      return std::any_of(roster_.members.begin(), roster_.members.end(),
                         [&](const RosterMember& one) { return one.name == name; });
    };
    if (member.port.starts_with("@") && taken(member.name))
      return refuse(ExitCode::Usage,
                    fmt::format("{}duplicate `{}`; give it only once", member.place, member.port));
    const auto name = member.name;
    for (int i = 2; taken(member.name); ++i)
      member.name = fmt::format("{} {}", name, i);
    roster_.members.push_back(std::move(member));
    return {};
  }

  /// Normalises an endpoint, so that two spellings of one place compare equal.
  static std::string same_where(const uploader::Endpoint& endpoint) {
    using uploader::Scheme;
    std::error_code error;
    switch (endpoint.scheme) {
    case Scheme::Serial:
    case Scheme::Pty:
    case Scheme::Replay: {
      const auto path = std::filesystem::canonical(disk::as_path(endpoint.path), error);
      return error ? endpoint.path : path.string();
    }
    case Scheme::Rfcomm:
    case Scheme::Ble:
      return endpoint.name.empty() ? uploader::to_string(endpoint.address) : lower(endpoint.name);
    case Scheme::Tcp: return fmt::format("{}:{}", endpoint.host, endpoint.port);
    case Scheme::Sim: break;
    }
    return endpoint.text;
  }

  Roster& roster_;
  std::map<std::string, std::string> known_; ///< names of the robots by endpoint
};

/// The balls of a file in order of lines.
std::vector<std::pair<std::string, const KnownBall*>> in_order(const Config& config) {
  std::vector<std::pair<std::string, const KnownBall*>> balls;
  for (const auto& [name, ball] : config.balls)
    balls.emplace_back(name, &ball);
  std::sort(balls.begin(), balls.end(),
            [](const auto& a, const auto& b) { return a.second->line < b.second->line; });
  return balls;
}

bool names_group(const Context& context, const std::string& port) {
  return port.starts_with("@") && context.config.groups.contains(port.substr(1));
}

} // namespace

void add_roster_options(const Command& command, RosterOptions& options, const std::string& jobs) {
  command
      .add_option(
          "-p,--port", options.ports,
          fmt::format(
              "where the ball is: {}, replay://, @ball or @group; repeat it for several robots",
              uploader::port_kinds))
      .one_value_each()
      .environment("ORB_PORT")
      .type_name("URL")
      .show_default("sim:");
  add_rest(command, options, jobs);
}

void add_robot_roster_options(const Command& command, RosterOptions& options,
                              const std::string& jobs) {
  command
      .add_option(
          "-p,--port", options.ports,
          fmt::format("the robot that the program drives from this computer: {}, @ball or @group; "
                      "repeat it for several robots",
                      uploader::port_kinds))
      .one_value_each()
      .type_name("URL");
  add_rest(command, options, jobs);
}

tl::expected<Roster, Failure> find_roster(const Context& context, const RosterOptions& options) {
  Roster roster;
  roster.config = context.config;
  if (options.file.empty() &&
      (options.ports.empty() ||
       (options.ports.size() == 1 && !names_group(context, options.ports.front())))) {
    const auto port = options.ports.empty() ? std::string("sim:") : options.ports.front();
    roster.members.push_back({port, port, "", {}});
    return roster;
  }
  const auto* from_environment = std::getenv("ORB_PORT");
  if (!options.file.empty() && options.ports.size() == 1 && from_environment != nullptr &&
      options.ports.front() == from_environment)
    return refuse(ExitCode::Usage,
                  fmt::format("ORB_PORT is {}, and `--ports` names {}: `unset ORB_PORT` for all "
                              "robots in the file",
                              from_environment, options.file));
  roster.is_one = false;
  Naming naming(roster);
  if (!options.file.empty()) {
    auto read = read_roster(options.file);
    if (!read)
      return refuse(ExitCode::Usage, read.error().message);
    roster.config.balls = std::move(read->balls);
    roster.config.groups = std::move(read->groups);
    for (const auto& [name, group] : roster.config.groups)
      if (auto good = naming.check_group(name, group); !good)
        return tl::unexpected(good.error());
  }
  if (options.ports.empty())
    for (const auto& [name, ball] : in_order(roster.config))
      if (auto added = naming.add("@" + name, ""); !added)
        return tl::unexpected(added.error());
  for (const auto& port : options.ports)
    if (auto added = naming.add(port, ""); !added)
      return tl::unexpected(added.error());
  return roster;
}

} // namespace orb::cli
