#pragma once

#include "debug/letter_holders.h"
#include "run/input.h"
#include "run/run.h"

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace orb::debug {

/// A line of a source.
struct Spot {
  std::uint32_t file = 0; ///< index into Sources::files
  std::uint32_t line = 1;

  friend auto operator<=>(const Spot&, const Spot&) = default;
};

/// The files of a run, and the source lines that the robot's lines and commands come from.
class Sources {
public:
  /// The inputs must outlive it.
  Sources(std::span<const run::Input> inputs, const run::Options& options);

  struct File {
    std::string name;
    const Source* source = nullptr;
  };
  const std::vector<File>& files() const { return files_; }
  /// The file of the first program, or else of the first macro.
  std::uint32_t main_file() const { return main_file_; }
  /// `patrol.orb:12`.
  std::string words(Spot spot) const;
  /// The text of the line without surrounding blanks.
  std::string_view text(Spot spot) const;
  /// The file with this name, or the one whose path ends with it.
  std::optional<std::uint32_t> file(std::string_view name) const;

  /// A sub active at a line. It may be inlined, so that the robot makes no call.
  struct Level {
    std::uint32_t call = 0; ///< number of the inlined source call; 0: a call of the robot
    Spot spot;              ///< the line itself for the innermost level, else the call
    std::string sub;        ///< empty for the main part

    bool is_same(const Level& other) const { return call == other.call && sub == other.sub; }
  };

  /// A line of a robot program.
  struct Line {
    std::uint32_t number = 0;
    Spot spot;
    std::vector<Level> levels; ///< outermost first; the last one is the line itself
    /// How many levels it shares with the previous robot line; the others begin here.
    std::size_t shared = 0;
    bool begins = false; ///< first robot line of its spot
    /// The symbol in each letter before the line, as far as known.
    Holders symbols{};
  };
  /// Returns null if the program in that area has no such line.
  const Line* line(spec::Area area, int number) const;
  const run::Input* input(spec::Area area) const;
  std::optional<Spot> spot(int macro, int command) const;
  std::string macro_name(int macro) const;

  /// The first line of the file with code, starting at `line`.
  std::optional<std::uint32_t> runs(std::uint32_t file, std::uint32_t line) const;
  /// The robot lines that begin a spot.
  std::vector<int> robot_lines(Spot spot) const;
  /// How many levels two lines share.
  static std::size_t shared(const Line& a, const Line& b);
  /// True if some line begins that sub.
  bool has_sub(std::string_view name) const;
  /// The spots at which a sub begins; `name` may be a line number. For an inlined sub, its calls.
  std::vector<Spot> subs(std::string_view name) const;

private:
  struct ProgramOf {
    const run::Input* input = nullptr;
    spec::Area area{};
    std::uint32_t first_file = 0;
    std::map<int, Line> lines;
  };
  void add_program(const run::Input& input, spec::Area area, std::uint32_t file);

  std::vector<File> files_;
  std::uint32_t main_file_ = 0;
  std::vector<ProgramOf> programs_;
  struct Command {
    int macro = 0;
    int command = 0;
    Spot spot;
  };
  std::vector<Command> commands_;
  std::map<int, std::string> macro_names_;
};

} // namespace orb::debug
