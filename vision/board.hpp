// The rules' view of the stones: what is in play, in the house and shot stone (World Curling, Rules of Curling, R1
// "Sheet", R5 "Sweeping", R7 "Free guard zone", R11 "Scoring"). A plain struct for the strategy.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "vision/geometry/sheet.hpp"
#include "vision/percepts/stones.hpp"

namespace hogline::vision {

/// One stone under the rules. Margins are positive while the stone is good, zero where the rule turns, in metres.
struct RuledStone {
  StoneSighting seen;
  double tee_distance_m = 0.0;  ///< from the stone's centre to the tee
  double side_margin_m = 0.0;   ///< to touching the nearer sideline; large where there is none
  double back_margin_m = 0.0;   ///< to lying wholly behind the back line
  double hog_margin_m = 0.0;    ///< from wholly clearing the hog line
  double house_margin_m = 0.0;  ///< by which it bites the outermost ring
  bool in_play = false;         ///< touches no sideline, not wholly behind the back line, not hogged
  bool in_house = false;        ///< in play, and bites the outermost ring
  bool hogged = false;          ///< does not wholly clear the hog line; good all the same if it hit a stone in play
  bool certain = true;          ///< no margin that decides is smaller than two of the place's sigmas
  std::vector<std::string> touches;  ///< centre_line, tee_line, back_line, hog_line, left_sideline, right_sideline
  int order = 0;                     ///< 1 for the stone of all nearest to the tee, and so on; 0 when not in the house
};

struct Board {
  std::vector<RuledStone> stones;   ///< in the house by their distance to the tee, then the others by theirs
  std::optional<std::size_t> shot;  ///< the shot stone; nothing in an empty house
  Team scoring = Team::unknown;     ///< whose the shot stone is
  int score = 0;                    ///< how many of its stones lie better than the other team's best; stones of an
                                    ///< unknown team end the count
  bool shot_certain = false;        ///< the two best distances of different teams differ by more than their doubt
};

/// `sheet_width_m` between the sidelines' inner edges; nothing where there are none to touch.
Board judge(const std::vector<StoneSighting>& stones, std::optional<double> sheet_width_m,
            double stone_radius_m = rules::stone_radius_m);

}  // namespace hogline::vision
