// Command lines of what reads pictures.
#include <CLI/CLI.hpp>
#include <memory>

#include "src/board_command.hpp"
#include "src/cli/commands.hpp"
#include "src/pose_command.hpp"
#include "src/stones_command.hpp"
#include "src/track_command.hpp"

namespace hogline::cli {

void add_pose(CLI::App& app, Chosen& chosen) {
  const auto kept = std::make_shared<PoseOptions>();
  PoseOptions& options = *kept;
  auto* pose = app.add_subcommand("pose", "the sheet's pose from pictures, one JSON object a line");
  pose->add_option("--rig", options.rig, "rig file (YAML): the camera and what is known of the sheet")->required();
  pose->add_option("--camera", options.camera, "which camera of the rig took the pictures")
      ->required()
      ->check(CLI::IsMember({"near", "low"}));
  auto* sequence = pose->add_flag("--sequence", options.sequence,
                                  "the pictures are consecutive frames: each is predicted from those before");
  pose->add_option("--rate", options.rate_hz, "frames a second of the sequence; without it 60, and a video's own")
      ->needs(sequence);
  pose->add_option("--draw", options.draw, "folder for the pictures with what was seen drawn on them");
  pose->add_option(
          "IMAGE", options.images,
          "pictures as the camera gives them, or one recording of them: a folder, a video, a stamps file (.csv)")
      ->required();
  pose->footer(
      "Examples:\n"
      "  hogline pose --rig rig.yaml --camera near frame.jpg\n"
      "  hogline pose --rig rig.yaml --camera near --sequence --rate 60 turn-*.jpg\n"
      "  hogline pose --rig rig.yaml --camera low --sequence --rate 60 run-*.jpg\n"
      "  hogline pose --rig rig.yaml --camera low --sequence run.mp4\n"
      "A stamps file has the first line name,id,time_s and then a line for each picture.\n"
      "That all pictures are there is checked first. One that is damaged, or of another size, is one that is not\n"
      "estimated: its line says why, and the rest go on.\n"
      "Exit status: 0 all estimated, 1 some picture not estimated, 2 wrong use or configuration,\n"
      "3 something outside failed (a disk, a port).");
  pose->callback([kept, &chosen] { chosen = [kept] { return run_pose(*kept); }; });
}

void add_stones(CLI::App& app, Chosen& chosen) {
  const auto kept = std::make_shared<StonesOptions>();
  StonesOptions& options = *kept;
  auto* stones = app.add_subcommand("stones", "the stones on the sheet from pictures of the near or the far camera");
  stones->add_option("--rig", options.rig, "rig file (YAML): the camera, the sheet and the stones' handles")
      ->required();
  stones->add_option("--camera", options.camera, "which camera of the rig took the pictures")
      ->capture_default_str()
      ->check(CLI::IsMember({"near", "far"}));
  stones
      ->add_option("--at", options.at,
                   "with --camera far: where the body stands, X_M,Y_M,YAW_DEG, as the near view measured it")
      ->type_name("X_M,Y_M,YAW_DEG");
  stones->add_flag("--sequence", options.sequence,
                   "the pictures are of one robot that stands still: one line with their stones' means");
  stones->add_option("--draw", options.draw, "folder for the pictures with what was seen drawn on them");
  stones
      ->add_option("IMAGE", options.images,
                   "pictures as the camera gives them, or one recording of them: a folder, a video, a stamps file")
      ->required();
  stones->footer(
      "Prints one JSON object a line, places in metres from the tee of the house in view.\n"
      "Examples:\n"
      "  hogline stones --rig rig.yaml frame.jpg\n"
      "  hogline stones --rig rig.yaml --sequence frame-*.jpg\n"
      "  hogline stones --rig rig.yaml --camera far --at=-0.15,-3.51,1.1 far.jpg\n"
      "The far camera's mount in the rig is with the head's pan and tilt of the picture; what the picture shows of "
      "the\n"
      "sheet corrects it by up to a degree.\n"
      "That all pictures are there is checked first. One that is damaged, or of another size, is one that is not\n"
      "estimated: its line says why, and the rest go on.\n"
      "Exit status: 0 all estimated, 1 some picture not estimated (of a sequence: none), 2 wrong use or\n"
      "configuration.");
  stones->callback([kept, &chosen] { chosen = [kept] { return run_stones(*kept); }; });
}

void add_board(CLI::App& app, Chosen& chosen) {
  const auto kept = std::make_shared<BoardOptions>();
  BoardOptions& options = *kept;
  auto* board = app.add_subcommand("board", "what lies on the sheet under the rules, printed and drawn");
  board->add_option("--rig", options.rig, "rig file (YAML): the camera, the sheet and the stones' handles")->required();
  board->add_option("--out", options.out, "folder for the drawing");
  board->add_option("IMAGE", options.images, "pictures of one robot that stands still; their stones are averaged")
      ->required();
  board->footer(
      "Example:\n"
      "  hogline board --rig rig.yaml --out out/board frame-*.jpg\n"
      "Exit status: 0 seen, 1 not seen in any picture, 2 wrong use or configuration.");
  board->callback([kept, &chosen] { chosen = [kept] { return run_board(*kept); }; });
}

void add_track(CLI::App& app, Chosen& chosen) {
  const auto kept = std::make_shared<TrackOptions>();
  TrackOptions& options = *kept;
  auto* track = app.add_subcommand("track", "a recorded throw, followed as the skip follows a live one");
  track->add_option("--rig", options.rig, "rig file (YAML) of the skip whose cameras took the pictures")->required();
  track->add_option("--at", options.at,
                    "X_M,Y_M,YAW_DEG of the body in the end's frame; without it the near view measures it while the "
                    "head stands");
  track->add_option("--spin", options.spin_radps,
                    "the stone's rate of turn at release, rad/s, counter-clockwise positive; without it not known");
  track->add_option("--ice", options.ice,
                    "file of what throws have taught of the ice: read if it is there, and written afterwards");
  track->add_option("--out", options.out, "folder for result.json, trajectory.csv and above.png")
      ->capture_default_str();
  track
      ->add_option("FOLDER", options.folder,
                   "of the recording: near.csv and far.csv (name,id,time_s), one of them at least, and head.csv "
                   "(time_s,pan_deg,tilt_deg)")
      ->required();
  track->footer(
      "Examples:\n"
      "  hogline skip --throw hit --seed 3 --far-hz 10 --near-hz 10 --record out/recorded\n"
      "  hogline track --rig config/rigs/skip.yaml --out out/track out/recorded\n"
      "  hogline track --rig rig.yaml --at 0.1,-4.1,0.5 --spin 1.57 only_far_pictures\n"
      "doc/skip.md says what the JSON object holds.\n"
      "Exit status: 0 the throw was followed to its end, 1 it was not (the reason says why), 2 wrong use or\n"
      "configuration, 3 something outside failed (a disk).");
  track->callback([kept, &chosen] { chosen = [kept] { return run_track(*kept); }; });
}

}  // namespace hogline::cli
