/* The reflex plane in C: two dozen encounters on the model of the package's car, and what was done
 * in each, as a table (CSV). Another processor's table should be the same but for the last digits.
 * Built against an installed package. */
#include <stddef.h>
#include <stdio.h>

#include "saca/onboard/reflex/saca_reflex.h"

typedef struct {
  const char* name;
  int32_t kind;
  double time;    /* after which the ego would be there [s] */
  double left;    /* from the ego's way, then [m] */
  double to_left; /* its own speed across the ego's way [m/s] */
  double ahead;   /* and along it [m/s] */
  double length, width, mass;
} situation;

static const situation situations[] = {
    {"wreck in the lane", SACA_OBSTACLE, 2.5, 0.0, 0.0, 0.0, 4.5, 1.8, 1500.0},
    {"wreck half across the lane", SACA_OBSTACLE, 2.0, 1.2, 0.0, 0.0, 4.5, 1.8, 1500.0},
    {"pedestrian from the right", SACA_PEDESTRIAN, 2.2, 0.0, 1.5, 0.0, 0.5, 0.5, 75.0},
    {"slower car", SACA_CAR, 2.4, 0.0, 0.0, 3.0, 4.5, 1.8, 1500.0},
};
static const double speeds[] = {9.0, 14.0, 19.0};
static const double grips[] = {0.9, 0.5};

enum { looks_per_second = 100, commands_per_look = 10 };

/* What a call that must not fail returned. */
static int is_fine(saca_status status, const char* what) {
  if (status != SACA_OK) {
    fprintf(stderr, "reflex_in_c: %s: %s\n", what, saca_status_text(status));
  }
  return status == SACA_OK;
}

static saca_scene begin(const situation* situation, double speed, double grip) {
  saca_scene scene;
  saca_scene_init(&scene);
  scene.v_B.x = speed;
  scene.grip = grip;
  scene.road.left_edge = 5.25;
  scene.road.right_edge = -5.25;
  scene.num_actors = 1;
  saca_actor* actor = &scene.actors[0];
  actor->kind = situation->kind;
  actor->length = situation->length;
  actor->width = situation->width;
  actor->mass = situation->mass;
  actor->v_W.x = situation->ahead;
  actor->v_W.y = situation->to_left;
  actor->X_WA.x = (speed - situation->ahead) * situation->time + 4.5;
  actor->X_WA.y = situation->left - situation->to_left * situation->time;
  return scene;
}

/* Six seconds of driving; returns whether every call was fine. */
static int drive(saca_reflex* reflex, const situation* situation, double speed, double grip) {
  saca_scene scene = begin(situation, speed, grip);
  saca_model* model = NULL;
  if (!is_fine(saca_model_open(reflex, &scene, &model), "model")) {
    return 0;
  }
  saca_measured measured;
  saca_command command;
  saca_answer answer;
  saca_measured_init(&measured);
  saca_command_init(&command);
  saca_answer_init(&answer);
  double begun_at = -1.0;
  saca_plan plan = {SACA_NO_INTERVENTION, 0, 0.0, 1.0};
  int fine = is_fine(saca_model_measure(model, &measured), "measuring");
  for (int look = 0; fine && look < 6 * looks_per_second; ++look) {
    fine = is_fine(saca_reflex_step(reflex, &scene, &answer), "step");
    if (answer.begins && begun_at < 0.0) {
      begun_at = scene.time;
      plan = answer.plan;
    }
    for (int k = 0; fine && k < commands_per_look; ++k) {
      fine = is_fine(saca_reflex_control(reflex, &measured, 0.001, &command), "control") &&
             is_fine(saca_model_step(model, &command, grip, 0.001), "the car") &&
             is_fine(saca_model_measure(model, &measured), "measuring");
    }
    scene.time = (look + 1.0) / looks_per_second;
    scene.X_WB = measured.X_WB;
    scene.v_B = measured.v_B;
    scene.a_B = measured.a_B;
    scene.yaw_rate = measured.yaw_rate;
    scene.actors[0].X_WA.x += situation->ahead / looks_per_second;
    scene.actors[0].X_WA.y += situation->to_left / looks_per_second;
  }
  printf("%s,%.1f,%.1f,%d,%.3f,%.2f,%.6f,%.6f,%.6f,%.6f\n", situation->name, speed, grip,
         plan.policy, plan.strength, begun_at, measured.X_WB.x, measured.X_WB.y, measured.X_WB.yaw,
         measured.v_B.x);
  saca_model_close(model);
  return fine && is_fine(saca_reflex_stand_down(reflex), "standing down");
}

int main(int num_arguments, char** arguments) {
  if (num_arguments != 2) {
    fprintf(stderr, "usage: reflex_in_c CAR.vehicle\n");
    return 2;
  }
  char message[512];
  saca_reflex* reflex = NULL;
  if (saca_reflex_open(arguments[1], SACA_REFLEX_VERSION, &reflex, message, sizeof message) !=
      SACA_OK) {
    fprintf(stderr, "reflex_in_c: %s\n", message);
    return 3;
  }
  int fine = 1;
  printf("situation,speed_m_s,grip,policy,strength,begun_s,x_m,y_m,yaw_rad,end_speed_m_s\n");
  for (size_t i = 0; fine && i < sizeof situations / sizeof situations[0]; ++i) {
    for (size_t j = 0; fine && j < sizeof speeds / sizeof speeds[0]; ++j) {
      for (size_t k = 0; fine && k < sizeof grips / sizeof grips[0]; ++k) {
        fine = drive(reflex, &situations[i], speeds[j], grips[k]);
      }
    }
  }
  saca_reflex_close(reflex);
  return fine ? 0 : 1;
}
