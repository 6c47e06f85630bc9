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

/// The files of a run, and which of their lines the robot's lines and commands stand for.
class Sources {
public:
  /// The inputs outlive it.
  Sources(std::span<const run::Input> inputs, const run::Options& options);

  struct File {
    std::string name;
    const Source* source = nullptr;
  };
  const std::vector<File>& files() const { return files_; }
  /// The file of the first program; of the first macro where there is none.
  std::uint32_t main_file() const { return main_file_; }
  /// `patrol.orb:12`.
  std::string words(Spot spot) const;
  /// The text of the line without blanks at its ends.
  std::string_view text(Spot spot) const;
  /// The file of that name, or the one whose name ends like it.
  std::optional<std::uint32_t> file(std::string_view name) const;

  /// A sub that is open where a line runs, though the robot itself may know of no call.
  struct Level {
    std::uint32_t call = 0; ///< which one of the source it was written for; 0: the robot calls it
    Spot spot;              ///< where it stands: of the innermost level the line, else a call
    std::string sub;        ///< empty in the main part

    bool is_same(const Level& other) const { return call == other.call && sub == other.sub; }
  };

  /// A line of a program of the robot.
  struct Line {
    std::uint32_t number = 0;
    Spot spot;
    std::vector<Level> levels; ///< the outermost first; the last one is that of the line itself
    /// How many of them the line of the robot before this one shares: the others begin here.
    std::size_t shared = 0;
    bool begins = false; ///< it is the first of those that its spot became
    /// Of each letter the symbol that it holds before the line, as far as that is certain.
    Holders symbols{};
  };
  /// Null where the program in that area has no such line.
  const Line* line(spec::Area area, int number) const;
  const run::Input* input(spec::Area area) const;
  std::optional<Spot> spot(int macro, int command) const;
  std::string macro_name(int macro) const;

  /// The first line of the file, from `line` on, that something runs for.
  std::optional<std::uint32_t> runs(std::uint32_t file, std::uint32_t line) const;
  /// The lines of the robot that begin a spot.
  std::vector<int> robot_lines(Spot spot) const;
  /// How many levels two lines share.
  static std::size_t shared(const Line& a, const Line& b);
  /// Whether some line begins that sub.
  bool has_sub(std::string_view name) const;
  /// The spots at which a sub begins: its name, or a line number. Of a sub that the compiler has
  /// computed within its callers' lines, where it is called.
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
