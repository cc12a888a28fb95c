#pragma once
// "Did you mean ...?"
#include <string>
#include <vector>

namespace windfall {

/// Fewest letters to insert, remove, replace or swap with their neighbour to turn `a` into `b`.
std::size_t edit_distance(const std::string& a, const std::string& b);

/// The candidates that `name` is most likely a misspelling of, best first, at most `count`; none that is no
/// nearer than about a third of its letters. Of dotted names the last part alone may agree: "gamma" finds
/// "material.gamma".
std::vector<std::string> nearest_names(const std::string& name, const std::vector<std::string>& candidates,
                                       std::size_t count = 1);

}  // namespace windfall
