#include "cli/commands/commands.h"
#include "cli/context/console.h"
#include "cli/context/json.h"
#include "cli/context/output_error.h"
#include "cli/robot/driven_robot.h"
#include "cli/robot/reach.h"
#include "cli/robot/sleep.h"
#include "cli/terminal/browser.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/keys.h"
#include "run/tether/pilot.h"
#include "serve/assets.h"
#include "serve/page_server.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <string>
#include <thread>

namespace orb::cli {
namespace {

using run::Pilot;

/// How long a key read from a pipe stays pressed.
constexpr Duration key_time = 200ms;
constexpr Duration glance = 20ms;
constexpr Duration between_words = 100ms;
/// A page sends its direction ten times a second while the stick is held.
constexpr Duration page_patience = 600ms;

struct DriveOptions {
  PortOptions port;
  std::string robot;
  bool keep_aim = false;
  bool sleeps = false;
  bool page = false;
  bool open = false;
};

struct KeyRow {
  std::string_view keys; ///< any of these characters
  Key named;             ///< or this key of a terminal
  Pilot::Key means;
  std::string_view words;
};

constexpr KeyRow key_rows[] = {
    {"w", Key::Up, Pilot::Key::Faster, "w or up: faster"},
    {"s", Key::Down, Pilot::Key::Slower, "s or down: slower"},
    {"a", Key::LeftArrow, Pilot::Key::Left, "a or left: 15° to the left"},
    {"d", Key::RightArrow, Pilot::Key::Right, "d or right: 15° to the right"},
    {" x", Key::None, Pilot::Key::Stop, "space: stop"},
    {"z", Key::None, Pilot::Key::Ahead, "z: this way is ahead now"},
    {"c", Key::None, Pilot::Key::Color, "c: next colour"},
    {"b", Key::None, Pilot::Key::Lamp, "b: back lamp"},
};

std::string key_help() {
  std::string text;
  for (const auto& row : key_rows)
    text += fmt::format("{}{}", text.empty() ? "" : ", ", row.words);
  return text + ", q: quit";
}

const KeyRow* find_row(const Pressed& pressed) {
  for (const auto& row : key_rows)
    if ((pressed.key != Key::None && pressed.key == row.named) ||
        (pressed.key == Key::None && row.keys.find(pressed.character) != std::string_view::npos))
      return &row;
  return nullptr;
}

/// Reads whole numbers separated by blanks; nothing if the count differs.
template <std::size_t Count>
std::optional<std::array<int, Count>> numbers_in(std::string_view text) {
  std::array<int, Count> numbers{};
  for (auto& number : numbers) {
    text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{})
      return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  }
  return text.empty() ? std::optional(numbers) : std::nullopt;
}

/// The last three numbers as a colour; nothing if one is outside 0 to 255.
template <std::size_t Count>
std::optional<vm::Color> color_in(const std::optional<std::array<int, Count>>& numbers) {
  if (!numbers)
    return std::nullopt;
  const auto last = numbers->end() - 3;
  if (std::any_of(last, numbers->end(), [](int one) { return one < 0 || one > UINT8_MAX; }))
    return std::nullopt;
  return vm::Color{static_cast<std::uint8_t>(last[0]), static_cast<std::uint8_t>(last[1]),
                   static_cast<std::uint8_t>(last[2])};
}

/// `255 200 0 hello`: shows the text in the given colour.
void say_on_matrix(Pilot& pilot, std::string_view body) {
  auto blank = body.find(' ');
  for (int numbers = 1; numbers < 3 && blank != body.npos; ++numbers)
    blank = body.find(' ', blank + 1);
  if (blank == body.npos)
    return;
  if (const auto color = color_in(numbers_in<3>(body.substr(0, blank))))
    pilot.say(std::string(body.substr(blank + 1)), *color);
}

/// Carries out a request from the page; ignores unknown ones.
void obey_page(Pilot& pilot, std::string_view path, std::string_view body) {
  const auto is_byte = [](int value) { return value >= 0 && value <= UINT8_MAX; };
  if (path == "stop")
    pilot.stop();
  else if (path == "ahead")
    pilot.press(Pilot::Key::Ahead);
  else if (path == "lamp")
    pilot.press(Pilot::Key::Lamp);
  else if (path == "drive") {
    if (const auto wheel = numbers_in<2>(body); wheel && is_byte((*wheel)[1]))
      pilot.steer((*wheel)[0], (*wheel)[1], page_patience);
  } else if (path == "color") {
    if (const auto color = color_in(numbers_in<3>(body)))
      pilot.show(*color);
  } else if (path == "pixel") {
    const auto lamp = numbers_in<5>(body);
    if (const auto color = color_in(lamp))
      pilot.paint((*lamp)[0], (*lamp)[1], *color);
  } else if (path == "text")
    say_on_matrix(pilot, body);
  else if (path == "clear")
    pilot.clear_matrix();
}

/// All values of the robot, with names and units, for the page.
Json values_of(const Pilot& pilot) {
  const auto& s = pilot.sample();
  auto list = Json::array();
  const auto add = [&](std::string_view name, std::string_view unit, double value) {
    constexpr double thousandth = 1000;
    list.push_back({name, unit, std::round(value * thousandth) / thousandth});
  };
  add("x", "cm", s.place_cm.x);
  add("y", "cm", s.place_cm.y);
  add("speed", "cm/s", std::hypot(s.velocity_cm_s.x, s.velocity_cm_s.y));
  add("yaw", "°", s.yaw_deg);
  add("pitch", "°", s.pitch_deg);
  add("roll", "°", s.roll_deg);
  add("acceleration x", "g", s.acceleration_g.x);
  add("acceleration y", "g", s.acceleration_g.y);
  add("acceleration z", "g", s.acceleration_g.z);
  add("rotation x", "°/s", s.rotation_deg_s.x);
  add("rotation y", "°/s", s.rotation_deg_s.y);
  add("rotation z", "°/s", s.rotation_deg_s.z);
  if (pilot.battery())
    add("battery", "V", pilot.battery()->volts);
  return list;
}

std::string page_text() {
  std::string text(serve::page_html);
  for (const auto& [mark, part] : {std::pair{std::string_view("/*{style}*/"), serve::page_css},
                                   {"/*{script}*/", serve::page_js}})
    text.replace(text.find(mark), mark.size(), part);
  return text;
}

/// A drive from the keyboard, with or without a page.
class Session {
public:
  /// Tells if the link's time follows the clock, or has to be slowed down to it.
  enum class Pace : std::uint8_t { Link, Clock };

  Session(const Context& context, run::Tether& robot, Pilot& pilot, std::string title, Pace pace)
      : context_(context), robot_(robot), pilot_(pilot), title_(std::move(title)), pace_(pace),
        began_(robot.now()) {}

  tl::expected<void, Failure> serve_page() {
    auto page =
        serve::PageServer::start(page_text(), [this](std::string_view path, std::string_view body) {
          obey_page(pilot_, path, body);
        });
    if (!page)
      return tl::unexpected(Failure{ExitCode::File, page.error().message});
    page_ = *std::move(page);
    return {};
  }
  const std::string& url() const { return page_->url(); }

  /// Drives until the user ends it.
  tl::expected<void, Failure> go(Keys& keys) {
    for (;;) {
      const auto pressed = keys.next(page_ == nullptr ? Keys::Wait::ForPipe : Keys::Wait::No);
      if (pressed.key == Key::End && page_ == nullptr)
        return {};
      if (pressed.key == Key::None && pressed.character == 'q')
        return {};
      const auto* row = find_row(pressed);
      if (row != nullptr)
        pilot_.press(row->means);
      else if (pressed.key == Key::None && pressed.character > ' ')
        print_note(context_,
                   fmt::format("`{}` does nothing here; {}", pressed.character, key_help()));
      const auto wait = row != nullptr && !keys.from_terminal() ? key_time : glance;
      if (auto lived = live(wait); !lived)
        return lived;
      if (row != nullptr && !keys.from_terminal())
        print_out(pilot_.words() + "\n");
    }
  }

private:
  tl::expected<void, Failure> live(Duration time) {
    for (const auto until = robot_.now() + time; robot_.now() < until;) {
      if (page_ != nullptr)
        if (auto served = page_->poll(); !served)
          return served;
      pilot_.watch();
      if (auto pumped = robot_.pump(std::min(until, robot_.now() + glance),
                                    [&](const run::RobotMessage& said) { pilot_.hear(said); });
          !pumped)
        return pumped;
      if (pace_ == Pace::Clock)
        std::this_thread::sleep_for(glance);
      say();
    }
    return {};
  }

  void say() {
    if (robot_.now() < next_words_)
      return;
    next_words_ = robot_.now() + between_words;
    if (!context_.quiet && is_terminal(Stream::Out))
      print_out(fmt::format("\r\033[K{}", pilot_.words()));
    if (page_ == nullptr || page_->listeners() == 0)
      return;
    const double t = std::chrono::duration<double>(robot_.now() - began_).count();
    Json said{
        {"robot", title_}, {"t", t}, {"words", pilot_.words()}, {"values", values_of(pilot_)}};
    if (pilot_.has_matrix())
      said["matrix"] = vm::hex_of(pilot_.picture());
    page_->send(said.dump());
  }

  const Context& context_;
  run::Tether& robot_;
  Pilot& pilot_;
  std::string title_;
  Pace pace_;
  Instant began_;
  Instant next_words_{};
  std::unique_ptr<serve::PageServer> page_;
};

tl::expected<void, Failure> drive_by_hand(Context& context, const DriveOptions& options) {
  const InterruptGuard guard;
  auto connected = connect_robot(context, options.port, options.robot);
  if (!connected)
    return tl::unexpected(connected.error());
  auto& link = (*connected)->link;
  auto& tether = (*connected)->tether;
  const auto named = [&](Failure failure) {
    return tl::unexpected(name_robot(link, options.robot, std::move(failure)));
  };
  run::Tether robot(*link.transport, tether.robot, tether.budgets, {}, tether.reopen);
  const auto first = robot.begin(options.keep_aim ? run::Aim::Keep : run::Aim::Zero);
  if (!first)
    return named(first.error());
  Pilot pilot(robot, tether.robot, *first);
  if (robot.battery())
    pilot.hear({*robot.battery()});
  Keys keys;
  const bool for_people = keys.from_terminal() || options.page || options.open;
  Session session(context, robot, pilot, std::string(spec::info(tether.robot).title),
                  link.is_sim && for_people ? Session::Pace::Clock : Session::Pace::Link);
  if (options.page || options.open) {
    if (auto served = session.serve_page(); !served)
      return served;
    print_note(context, "the joystick: " + session.url());
    if (options.open)
      if (const auto shown = show_in_browser(session.url()); !shown)
        print_error(context, shown.error());
  }
  if (keys.from_terminal())
    print_note(context, key_help());
  std::optional<OutputError> unread; // nobody reads the output any more
  const auto end = run::drive_attended(robot, [&]() -> tl::expected<void, Failure> {
    try {
      auto driven = session.go(keys);
      keys.give_back();
      if (keys.from_terminal())
        print_out("\n");
      return driven;
    } catch (const OutputError& error) {
      unread = error;
      return {};
    }
  });
  const auto& [driven, stopped] = end;
  print_ended(context, stopped ? ExitCode::Done : ExitCode::LinkLost,
              stopped ? run::stop_done : run::stop_lost);
  if (options.sleeps) {
    const auto slept = robot.is_reopened() || !stopped
                           ? left_awake()
                           : put_to_sleep(*link.transport, tether.robot, link);
    print_ended(context, slept.exit, slept.words);
    context.exit = slept.exit;
  }
  if (unread && InterruptGuard::asked() == 0)
    throw *unread;
  if (unread)
    return tl::unexpected(Failure{ExitCode::Interrupted, "interrupted"});
  if (driven && !stopped)
    context.exit = ExitCode::LinkLost;
  return driven ? driven : named(driven.error());
}

} // namespace

void add_drive(const Command& orb, Context& context) {
  const auto command = orb.add_command("drive", "drive a robot by hand and see what it senses",
                                       "orb drive --port ble://SB-1A2B\n"
                                       "orb drive --port ble://SB-1A2B --open\n"
                                       "orb drive --port sim: --robot bolt --open\n"
                                       "printf 'wwwdddx' | orb drive --port sim: --robot mini");
  auto options = std::make_shared<DriveOptions>();
  add_robot_port_options(command, options->port, options->robot);
  command.find("--port")->required();
  add_sleep_option(command, options->sleeps);
  command.add_flag("--no-aim", options->keep_aim, "keep the robot's heading and position");
  command.add_flag("--page", options->page,
                   "serve a page with a joystick and live curves, on this computer only");
  command.add_flag("--open", options->open, "serve the page and open it in a browser");
  command.footer("Keys: " + key_help());
  command.callback([&context, options] {
    if (const auto done = drive_by_hand(context, *options); !done)
      fail(context, done.error());
  });
}

} // namespace orb::cli
