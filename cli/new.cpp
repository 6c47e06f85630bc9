#include "cli/commands.h"
#include "disk/disk.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <memory>

namespace orb::cli {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::string folder;
  bool structured = false;
};

struct Starter {
  std::string_view name;
  std::string_view text;
};

// A project that checks without a finding and runs at once. `%` stands for its name, `.@` for the
// ending of its program.
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
    {"world.stimulus", R"(# What happens to the ball while it runs (docs/ball.md lists every line).
at 10s shake
)"},
    {"orb.toml", R"(# Defaults for every orb command in this folder; flags are stronger.
[check]
target = "1.6"

# Balls by name, used as `--port @red`.
# [balls]
# red = "rfcomm://68:86:E7:00:11:22"
)"},
    {"README.md", R"(# %

    orb check %.@ wink.macro
    orb run %.@ --stimulus world.stimulus --report report.html
    orb run wink.macro
    orb upload %.@ --port rfcomm://68:86:E7:00:11:22 --run
)"},
});

std::string filled(std::string_view text, const std::string& name, std::string_view ending) {
  std::string out;
  for (const char c : text) {
    if (c == '%')
      out += name;
    else if (c == '@' && out.ends_with('.'))
      out += ending;
    else
      out += c;
  }
  return out;
}

void make(Context& context, const Options& options) {
  const auto& folder = options.folder;
  const fs::path path(folder);
  std::error_code error;
  if (fs::exists(path, error) && (!fs::is_directory(path, error) || !fs::is_empty(path, error))) {
    return fail(context,
                {ExitCode::File, fmt::format("`{}` already exists; choose another name", folder)});
  }
  fs::create_directories(path, error);
  if (error)
    return fail(context,
                {ExitCode::File, fmt::format("cannot make `{}`: {}", folder, error.message())});
  auto name = fs::absolute(path, error).lexically_normal().filename().string();
  if (name.empty())
    name = fs::absolute(path, error).lexically_normal().parent_path().filename().string();
  const auto& program = options.structured ? structured : numbered;
  const auto ending = program.name.substr(2);
  std::vector<Starter> files{program};
  files.insert(files.end(), starters.begin(), starters.end());
  for (const auto& starter : files) {
    const auto file = (path / filled(starter.name, name, ending)).lexically_normal().string();
    const auto text = filled(starter.text, name, ending);
    if (const auto written = disk::write(file, as_bytes(text)); !written)
      return fail(context, {ExitCode::File, written.error().message});
    print_out(fmt::format("{}\n", file));
  }
  const auto step = folder == "." ? std::string() : fmt::format("  cd {}\n", folder);
  print_note(context, fmt::format("now try:\n{}  orb run {}.{} --stimulus world.stimulus "
                                  "--report report.html",
                                  step, name, ending));
}

} // namespace

void add_new(CLI::App& app, Context& context) {
  auto* command = add_command(app, "new", "make a folder with a working starter project",
                              "orb new dance\norb new dance --structured\norb new .");
  auto options = std::make_shared<Options>();
  command
      ->add_option("NAME", options->folder,
                   "the folder to make: a program, a macro, a stimulus script and settings")
      ->required()
      ->check([](const std::string& name) {
        return name.empty() ? std::string("a name is needed") : std::string();
      });
  command->add_flag("--structured", options->structured,
                    "the program has names and blocks in place of line numbers (.orb)");
  command->callback([&context, options] { make(context, *options); });
}

} // namespace orb::cli
