/// One line with the progress of a phase of a run and the time left.
#pragma once

#include <cstddef>
#include <functional>
#include <iosfwd>
#include <string>

namespace mergel::apps {

/// "1 min 20 s": a duration [s] in its two largest units, rounded; "0 s" if negative.
std::string duration_text(double seconds);

/// Where a progress line goes.
struct ProgressOutput {
  std::ostream* out = nullptr;
  /// A terminal has one line, rewritten at most 5 times a second; else one line every 10 s.
  bool is_terminal = false;
  std::size_t columns = 79;      ///< longest line on a terminal; it must not wrap
  std::function<double()> clock; ///< seconds since any instant, never decreasing

  /// std::cout, with the width of the terminal where it is one. A terminal without a width,
  /// as that of a rank of mpirun, counts as a file.
  static ProgressOutput standard();
};

/// Progress of one phase of a run:
///
///     penetration  41.2 %  depth 1.15 mm (0.82 D_p)  1 min 20 s left
///
/// The time left follows from the rate smoothed over the last tenth of the elapsed time, 10 s
/// or more; it is not shown in the first two seconds, nor where nothing has moved on for 10 s,
/// as near an equilibrium. The destructor ends an open line,
/// so that an error message starts on a new line.
class Progress {
public:
  explicit Progress(std::string phase, ProgressOutput output = ProgressOutput::standard());
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// May be called every step.
  /// @param fraction part of the phase that is done, 0 to 1; the line never says less than
  ///   it did before
  /// @param detail   text between fraction and time left; called only when a line is
  ///   printed
  void update(double fraction, const std::function<std::string()>& detail);
  void update(double fraction, const std::string& detail = "");

  /// Print lines of another kind, each ended by a line break, above the progress.
  void say(const std::string& lines);

  /// Report the end of the phase: "penetration  done  <detail>  in 3 min
  /// 2 s", whole however wide the terminal is. Call it once.
  void done(const std::string& detail = "");

private:
  void show(const std::string& line);

  std::string phase_;
  ProgressOutput output_;
  double start_, shown_;                      ///< clock at the start and the last line [s]
  double measured_, measured_fraction_ = 0.0; ///< at the last update of the rate
  double advanced_;                           ///< clock when the fraction last grew [s]
  double rate_ = 0.0;                         ///< smoothed, fraction per second
  std::size_t line_length_ = 0;               ///< of the open line on a terminal
};

} // namespace mergel::apps
