/// One line that says how far a stage is and how long it still takes.
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
  /// On a terminal one line is rewritten, at most 5 times a second; else a line every 10 s.
  bool is_terminal = false;
  std::size_t columns = 79;      ///< longest line on a terminal; it must not wrap
  std::function<double()> clock; ///< seconds since any instant, never going back

  /// std::cout as it is: a terminal of some width, or a file or pipe.
  static ProgressOutput standard();
};

/// Progress of one stage:
///
///     driving  41.2 %  depth 1.15 mm (0.82 D_p)  1 min 20 s left
///
/// The time left comes from the smoothed rate of the last tenth of the run, 10 s at least;
/// it is left out for the first two seconds. Destruction ends an open line, so that an
/// error message starts in a line of its own.
class Progress {
public:
  explicit Progress(std::string stage, ProgressOutput output = ProgressOutput::standard());
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// @param fraction done of the stage, 0 to 1; may be called every step
  /// @param detail   what stands between fraction and time left; called only when shown
  void update(double fraction, const std::function<std::string()>& detail);
  void update(double fraction, const std::string& detail = "");

  /// Close the stage: "driving  done  <detail>  in 3 min 2 s". Once.
  void done(const std::string& detail = "");

private:
  void show(const std::string& line);

  std::string stage_;
  ProgressOutput output_;
  double start_, shown_;                      ///< instants [s]
  double measured_, measured_fraction_ = 0.0; ///< where the rate was last taken
  double rate_ = 0.0;                         ///< smoothed, fraction per second
  std::size_t line_length_ = 0;               ///< of the open line on a terminal
};

} // namespace mergel::apps
