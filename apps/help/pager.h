/// Showing a page to a person or a program.
#pragma once

#include <string>

namespace mergel::apps {

/// Print the text on standard output. Where that is a terminal with fewer lines than the text,
/// it goes through the program of $PAGER, else less; PAGER= or PAGER=cat prints it as it is.
/// @throws NumericalError as require_printed()
void show(const std::string& text);

} // namespace mergel::apps
