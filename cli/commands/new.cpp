#include "base/text/shell.h"
#include "base/text/text.h"
#include "cli/commands/commands.h"
#include "disk/disk.h"
#include "uploader/device_words.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <memory>

namespace orb::cli {
namespace {

namespace fs = std::filesystem;

struct NewOptions {
  std::string folder;
  bool numbered = false;
  bool structured = false; ///< the default, given explicitly
  bool course = false;
};

struct Starter {
  std::string_view name;
  std::string_view text;
};

// A project that passes `orb check` and runs at once. `%` is replaced by its name, `$` by its
// program's name quoted for the shell.
constexpr Starter numbered{"%.bas",
                           R"(' %: drives a square in four colours, then waits to be shaken.
10 locate 0,0
20 for S = 0 to 3
30 LEDC S + 1
40 goroll S * 90,100,1
50 delay 1200
60 goroll S * 90,0,0
70 delay 700
80 print "corner", S + 1 ": " xpos "," ypos
90 next S
100 LEDC 6
110 delay 50
120 if dshake = 0 then goto 110
130 print "shaken, goodbye"
140 LEDC 0
)"};

constexpr Starter structured{"%.orb",
                             R"(' %: drives a square in four colours, then waits to be shaken.
use "wink.macro"
const side = 1200ms

sub leg(heading_now)
  goroll heading_now, 100, 1
  delay side
  goroll heading_now, 0, 0
  delay 700ms
end sub

locate 0, 0
for corner = 1 to 4
  LEDC corner
  leg((corner - 1) * 90)
  print "corner", corner ": " xpos "," ypos
next corner

LEDC 6
while not dshake
  delay 50ms
end while
print "shaken, goodbye"
macrun wink
)"};

constexpr Starter test{"%.test",
                       R"(# What % should do: `orb test` says whether it does.
with wink.macro
for 30s
at 10s shake

test "drives a square"
  expect near 0,80 by 15cm
  expect near 80,80 by 15cm
  expect near 0,0 by 15cm at 9s
  expect print ~"corner" 4 times

test "waits for the shake"
  never print "shaken, goodbye" during 0s..9900ms
  expect print "shaken, goodbye" within 11s
  expect color off at end
)"};

/// The variant of the test for a project with a course.
std::string with_course(std::string text) {
  text.insert(text.find("with "), "course course.svg\n");
  return text + R"(
test "comes home"
  expect inside home at 9s
  never collision
)";
}

// A room of 2 m by 2 m, large enough for the square that the starters drive.
constexpr Starter course{"course.svg",
                         R"(<?xml version="1.0" encoding="UTF-8"?>
<!-- The course for %, in centimetres; open it in Inkscape or a browser.
     A class says what an element is: wall, start, or zone with an id. `orb spec course-rules` has the rest. -->
<svg xmlns="http://www.w3.org/2000/svg" width="200cm" height="200cm" viewBox="0 0 200 200">
  <style>
    .wall { fill: none; stroke: #14212b; stroke-width: 3 }
    .zone { fill: #1d5fd1; fill-opacity: .15; stroke: #1d5fd1 }
    .start { fill: none; stroke: #15803d; stroke-width: 1.5 }
    text { font: 600 7px sans-serif; fill: #536472 }
  </style>
  <rect class="wall" x="5" y="5" width="190" height="190"/>
  <path class="wall" d="M90 110V85H115"/>
  <circle class="zone" id="home" cx="50" cy="150" r="20"/>
  <text x="40" y="182">home</text>
  <rect class="zone" id="corner" x="120" y="20" width="60" height="60"/>
  <text x="124" y="75">corner</text>
  <circle class="start" cx="50" cy="150" r="4"/>
</svg>
)"};

constexpr auto starters = std::to_array<Starter>({
    {"wink.macro", R"(; %: winks twice and turns on the spot.
.macro wink id=40 flags=motor_control,endsig
  loop_start 2
    rgb 0 255 0
    delay 200
    rgb 0 0 0
    delay 200
  loop_end
  rotate 360 1000
  delay 1000
)"},
    {"world.stimulus",
     R"(# What happens to the ball while it runs (`orb spec stimuli` lists every line).
at 10s shake
)"},
    {"orb.toml", R"(# Defaults for every orb command in this folder; flags override them.
[check]
target = "1.7"

# Balls by name, used as `--port @red`.
# [balls]
# red = "rfcomm://68:86:E7:00:11:22"
)"},
    {"README.md", R"(# %

    orb check $ wink.macro
    orb run $ --stimulus world.stimulus --report report.html
    orb test
    orb run wink.macro
    orb upload $ --port rfcomm://68:86:E7:00:11:22 --run
)"},
});

std::string filled(std::string_view text, const std::string& name, std::string_view ending) {
  std::string out;
  for (const char c : text) {
    if (c == '%')
      out += name;
    else if (c == '$')
      out += shell_word(fmt::format("{}.{}", name, ending));
    else
      out += c;
  }
  return uploader::with_ports_of_this_system(std::move(out));
}

void make(Context& context, const NewOptions& options) {
  const auto& folder = options.folder;
  const auto path = disk::as_path(folder);
  std::error_code error;
  if (fs::exists(path, error) && (!fs::is_directory(path, error) || !fs::is_empty(path, error))) {
    return fail(context,
                {ExitCode::File, fmt::format("`{}` already exists; choose another name", folder)});
  }
  fs::create_directories(path, error);
  if (error)
    return fail(context,
                {ExitCode::File, fmt::format("cannot create `{}`: {}", folder, error.message())});
  auto name = fs::absolute(path, error).lexically_normal().filename().string();
  if (name.empty())
    name = fs::absolute(path, error).lexically_normal().parent_path().filename().string();
  const auto& program = options.numbered ? numbered : structured;
  const auto ending = program.name.substr(2);
  std::vector<Starter> files{program};
  files.push_back(test);
  files.insert(files.end(), starters.begin(), starters.end());
  if (options.course)
    files.push_back(course);
  for (const auto& starter : files) {
    const auto file = (path / disk::as_path(filled(starter.name, name, ending)))
                          .lexically_normal()
                          .generic_string();
    auto text = filled(starter.text, name, ending);
    if (options.course && starter.text == test.text)
      text = with_course(std::move(text));
    if (const auto written = disk::write(file, as_bytes(text)); !written)
      return fail(context, {ExitCode::File, written.error().message});
    print_out(fmt::format("{}\n", file));
  }
  print_note(context, "now try:");
  if (folder != ".")
    print_note(context, fmt::format("  cd {}", shell_word(folder)));
  print_note(context, fmt::format("  orb run {} --stimulus world.stimulus {}--report report.html",
                                  shell_word(fmt::format("{}.{}", name, ending)),
                                  options.course ? "--course course.svg " : ""));
}

} // namespace

void add_new(const Command& orb, Context& context) {
  const auto command =
      orb.add_command("new", "create a folder with a working starter project",
                      "orb new dance\norb new dance --course\norb new dance --numbered");
  auto options = std::make_shared<NewOptions>();
  command
      .add_option(
          "NAME", options->folder,
          "the folder to create: a program, its test, a macro, a stimulus script and settings")
      .required()
      .check([](const std::string& name) {
        return name.empty() ? std::string("a name is needed") : std::string();
      });
  const auto with_numbers = command.add_flag("--numbered", options->numbered,
                                             "the program has line numbers (.bas), as on the robot "
                                             "itself");
  command
      .add_flag("--structured", options->structured,
                "the program has names and blocks (.orb), which is the default")
      .excludes(with_numbers);
  command.add_flag("--course", options->course,
                   "also create a course: a drawing of walls, zones and a start");
  command.callback([&context, options] { make(context, *options); });
}

} // namespace orb::cli
