# With SEEKER_UNITY the sources of a target are compiled ten at a time, as one source. Unnamed namespaces are shared then: the
# second of two sources that use a name for two things, or each for itself, is compiled alone.
set(SEEKER_ALONE
    common/image/canvas.cpp
    client/cli/verbs_motion.cpp
    common/rpc/client_impl.cpp
    common/wire/convert_stream.cpp
    server/app/state/journal.cpp
    server/app/robot/map_service.cpp
    server/drivers/link/any_baud.cpp
    server/emulator/emulator_server.cpp
    server/explore/horizon_views.cpp server/explore/segment_sight.cpp server/explore/wall_faces.cpp
    server/explore/wall_follower.cpp
    server/lab/experiments/child_process.cpp
    server/lab/active_slam/explore_picture.cpp
    server/lab/search/search_figures.cpp
    server/lab/map_merging/merge_report.cpp
    server/lab/stereo_database/stereo_figures.cpp
    server/lab/line_detection/line_figures.cpp server/lab/line_detection/reproduce_line_detection.cpp
    server/lab/search/search_run.cpp
    server/lab/slam/slam_report.cpp
    server/lab/solids/solids_study.cpp
    server/localize/tracking_matcher.cpp
    server/nav/lookout.cpp server/nav/path_follower.cpp server/nav/seen_movers.cpp
    server/search/fuzzy_planner.cpp server/search/target_visit.cpp
    server/sim/image_chain.cpp server/sim/omni_columns.cpp server/sim/omni_renderer.cpp server/sim/rearrange.cpp
    server/sim/stereo_renderer.cpp server/sim/tank_renderer.cpp
    server/calibration/drive_calibration.cpp server/slam/global_matcher.cpp server/slam/likelihood_pyramid.cpp server/slam/pairwise_consistency.cpp
    server/slam/reference_cloud.cpp
    server/store/map_file.cpp server/store/schema.cpp server/store/sealed_file.cpp
    server/vision/bbf_tree.cpp server/vision/place_index.cpp server/vision/stereo_check.cpp
    tests/arch/test_rules.cpp
    tests/support/net/chaos_proxy.cpp
    tests/unit/common/image/test_map_picture.cpp
    tests/unit/common/wire/test_stream_sender.cpp
    tests/unit/server/app/maps/test_robot_map.cpp
    tests/unit/server/app/missions/test_rotate_and_look.cpp
    tests/unit/server/explore/test_doors.cpp tests/unit/server/explore/test_exploration.cpp
    tests/unit/server/explore/test_exploration_guards.cpp
    tests/unit/server/explore/test_viewpoint_strategies.cpp
    tests/unit/server/fleet/test_goal_choice.cpp
    tests/unit/server/lab/active_slam/test_explore_result.cpp
    tests/unit/server/lab/search/test_run_result.cpp
    tests/unit/server/nav/test_known_floor.cpp tests/unit/server/nav/test_lookout.cpp
    tests/unit/server/nav/test_retry_drive.cpp tests/unit/server/nav/test_seen_movers.cpp
    tests/unit/server/options/test_slam_options.cpp
    tests/unit/server/search/test_mission.cpp
    tests/unit/server/sim/test_simulation.cpp tests/unit/server/sim/test_stereo.cpp
    tests/unit/server/sim/test_tank.cpp
    tests/unit/server/slam/test_odometry_scale.cpp tests/unit/server/slam/test_pairwise_consistency.cpp
    tests/unit/server/store/test_store_kill.cpp
    tests/unit/server/vision/test_nearest.cpp)

# seeker_unite(TARGET): for a target whose sources are all of the current folder.
function(seeker_unite target)
  if(NOT SEEKER_UNITY)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 10)
  file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
  foreach(source IN LISTS SEEKER_ALONE)
    get_filename_component(its_folder ${source} DIRECTORY)
    if(its_folder STREQUAL folder)
      set_source_files_properties(${PROJECT_SOURCE_DIR}/${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    endif()
  endforeach()
endfunction()
