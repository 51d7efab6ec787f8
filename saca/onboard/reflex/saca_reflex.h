#ifndef SACA_REFLEX_H
#define SACA_REFLEX_H

/* The reflex plane for programs in C, and for languages that call C: one vehicle package in
 * (`saca atlas package`), then a scene in and an answer out at 10 to 100 Hz, and commands to the
 * car at up to 1,000 Hz. Nothing is thought: where a forecaster would have spoken, the atlas does,
 * which knows one motion of each road user, so that it chooses worse (docs/decisions/0037).
 *
 * Frames and units are those of ISO 8855: x ahead, y to the left, angles counter-clockwise in
 * radians; metres, seconds, kilograms. W is fixed to the ground, B to the ego at its centre of
 * mass, A to a road user at its body's centre, L to the ego's lane.
 *
 * One thread to a plane; `init` functions take no null pointer, all others say what they make of
 * one. After `saca_reflex_open` nothing is allocated (but by `saca_model_open`), locked or waited
 * for, and no function throws.
 * A struct that is handed over begins with its size, which `saca_..._init` fills in with the
 * defaults: a program built with another version gets SACA_OTHER_VERSION, and is not misread.
 */

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Changes whenever a struct or the meaning of a function does. */
#define SACA_REFLEX_VERSION 1
/* What the library was built with. */
int32_t saca_reflex_version(void);

/* What every function returns. */
enum {
  SACA_OK = 0,
  SACA_BAD_ARGUMENT = 1,  /* a null pointer, or a number that the function does not take */
  SACA_OTHER_VERSION = 2, /* header and library differ, or a struct has another size */
  SACA_UNREADABLE = 3,    /* the file cannot be read */
  SACA_MALFORMED = 4,     /* it is no vehicle package, or cut short, or altered */
  SACA_OTHER_CAR = 5,     /* its atlas is that of another car, or of another program */
  SACA_BAD_SCENE = 6,     /* it cannot be used, nor can what is known be carried on */
  SACA_FAILED = 7         /* no memory, or a fault of this library */
};
typedef int32_t saca_status;
/* In words; never null. */
const char* saca_status_text(saca_status status);

enum {
  SACA_CAR = 0,
  SACA_VAN = 1,
  SACA_TRUCK = 2,
  SACA_MOTORCYCLE = 3,
  SACA_BICYCLE = 4,
  SACA_PEDESTRIAN = 5,
  SACA_OBSTACLE = 6 /* at rest for good */
};
/* A segment is a line along x of width 0, and only an obstacle is one. */
enum { SACA_BOX = 0, SACA_ELLIPSE = 1, SACA_SEGMENT = 2 };
enum { SACA_STRAIGHT = 0, SACA_INTERSECTION = 1, SACA_ONE_WAY = 2 };
/* What stands beyond an edge of the road. */
enum { SACA_UNMARKED = 0, SACA_KERB = 1, SACA_BARRIER = 2, SACA_TREES = 3 };
/* The policies, by the numbers of Table I of the paper (arXiv 2504.00115). */
enum {
  SACA_AEB = 0,
  SACA_AES_LEFT = 1,
  SACA_AES_RIGHT = 2,
  SACA_ES_B_LEFT = 3,
  SACA_ES_B_RIGHT = 4,
  SACA_T_DRIFT_LEFT = 5,
  SACA_T_DRIFT_RIGHT = 6,
  SACA_NO_INTERVENTION = 7
};

typedef struct {
  double x, y; /* [m] */
  double yaw;  /* [rad] */
} saca_pose;
typedef struct {
  double x, y;
} saca_vector;

/* A road user or obstacle as perceived. Left out is whose numbers are none, or beyond what is on a
 * road: 1e7 m from the origin, a yaw of 1e4 rad, 200 m/s, 1,000 m/s^2, 100 rad/s, 1 mm to 1 km, 1 g
 * to 10,000 t. */
typedef struct {
  int32_t kind;         /* SACA_CAR ... SACA_OBSTACLE */
  int32_t id;           /* 1 to 255, unique within its kind, the same from scene to scene */
  int32_t shape;        /* SACA_BOX ... */
  int32_t is_occluded;  /* not seen now; the state is a prediction */
  double length, width; /* [m] */
  double mass;          /* [kg] */
  saca_pose X_WA;
  saca_vector v_W;    /* [m/s] */
  saca_vector a_W;    /* [m/s^2] */
  double yaw_rate;    /* [rad/s] */
  double position_sd; /* standard deviation on each axis [m] */
  double velocity_sd; /* likewise [m/s] */
  double existence;   /* probability that it is there at all, in [0, 1] */
  double age;         /* since it was last measured [s] */
} saca_actor;
/* A car of 4.5 m by 1.8 m and 1,500 kg at rest at the origin, measured now without error. */
void saca_actor_init(saca_actor* actor);

/* The ego's lane as an arc of constant curvature, and how far the ground reaches. */
typedef struct {
  int32_t topology;                      /* SACA_STRAIGHT ... */
  int32_t left_beyond, right_beyond;     /* SACA_UNMARKED ... */
  int32_t oncoming_left, oncoming_right; /* is the lane there one of oncoming traffic? */
  int32_t unused;
  saca_pose X_WL;               /* a point on the lane's centre line, x along it */
  double curvature;             /* > 0 turns left [1/m] */
  double lane_width;            /* [m] */
  double left_edge, right_edge; /* to the left of the centre line: left_edge > 0 > right_edge [m] */
} saca_road;

#define SACA_MAX_ACTORS 32
/* All that is known of one instant. */
typedef struct {
  uint64_t size;
  double time; /* since any instant, 1970 for one; a jump of more than 1 s begins a new drive:
                  what was known is forgotten, and what is under way dropped [s] */
  saca_pose X_WB;
  saca_vector v_B; /* over ground [m/s] */
  saca_vector a_B; /* [m/s^2] */
  double yaw_rate; /* [rad/s] */
  double grip;     /* best estimate of the friction coefficient, in (0, 1.2] */
  double grip_sd;  /* its standard deviation */
  saca_road road;
  uint64_t num_actors;
  saca_actor actors[SACA_MAX_ACTORS];
} saca_scene;
/* At rest at the origin of a straight road of one lane of 3.5 m, grip 0.9, nobody there. */
void saca_scene_init(saca_scene* scene);

/* A complete manoeuvre. */
typedef struct {
  int32_t policy; /* SACA_AEB ... */
  int32_t unused;
  double target_speed; /* of policies 3 and 4 [m/s]; NaN: it has none */
  double strength;     /* of policy 0, as a share of the grip, in [0.2, 1]; 1 of all others */
} saca_plan;

typedef struct {
  uint64_t size;
  int32_t carries_out;       /* is `plan` to be carried out? If not, the stack drives */
  int32_t begins;            /* it begins in this very answer */
  int32_t triggered;         /* by a decision at a trigger */
  int32_t switched;          /* in place of another; of no intervention, the wheel is given back */
  int32_t threatened;        /* is there a conflict within 5.5 s, all going on as they do? */
  int32_t encounter_is_over; /* the next trigger is another encounter's */
  int32_t degraded;          /* somebody or everything is carried on instead of seen */
  int32_t unused;
  int32_t threat_kind; /* of that conflict: whom with; -1: there is none */
  int32_t threat_id;
  double time_to_conflict; /* [s]; NaN: there is none */
  saca_plan plan;
} saca_answer;
void saca_answer_init(saca_answer* answer);

/* What the car measures of itself. */
typedef struct {
  uint64_t size;
  saca_pose X_WB;
  saca_vector v_B;        /* over ground [m/s] */
  saca_vector a_B;        /* [m/s^2] */
  double yaw_rate;        /* [rad/s] */
  double steering;        /* mean angle of the front road wheels, left positive [rad] */
  double wheel_speed[4];  /* front left, front right, rear left, rear right [rad/s] */
  double brake_torque[4]; /* at the wheels, as brake pressures tell, likewise [N m] */
  double motor_torque;    /* of all driven wheels [N m] */
  saca_vector load_a_B;   /* the acceleration that wheel loads have settled to: a_B behind a low
                             pass of some 0.1 s; a_B where nothing better is known [m/s^2] */
} saca_measured;
void saca_measured_init(saca_measured* measured);

/* What to tell the car. */
typedef struct {
  uint64_t size;
  double steering;        /* angle of the road wheels, left positive [rad] */
  double brake_torque[4]; /* [N m] */
  double motor_torque;    /* of all driven wheels [N m] */
} saca_command;
void saca_command_init(saca_command* command);

typedef struct saca_reflex saca_reflex; /* NOLINT(readability-identifier-naming): a name of C */

/* Reads a vehicle package into memory and makes sure that it is whole and belongs to this library
 * (some 50 ms); what becomes of the file then does not matter.
 *
 * version       SACA_REFLEX_VERSION
 * reflex        out: the plane; NULL where there is none
 * message       out: what is wrong with which file, in words; may be NULL
 * message_size  of `message` [bytes]; what does not fit is cut */
saca_status saca_reflex_open(const char* path, int32_t version, saca_reflex** reflex, char* message,
                             size_t message_size);
void saca_reflex_close(saca_reflex* reflex); /* NULL is fine */

/* The name of the package's car; data/vehicles/NAME.toml has its sizes, mass and where B lies. */
const char* saca_reflex_car_name(const saca_reflex* reflex); /* "" for NULL */

/* A scene came. Actors that break a rule, and second ones of a name, are left out; who was there
 * before, or all of a scene that breaks a rule as a whole, is carried on as it moved for half a
 * second. After that, SACA_BAD_SCENE: nothing new begins, what is under way goes on. Likewise
 * SACA_BAD_SCENE, though it breaks no rule, is a scene older than the newest by at most 1 s: it is
 * left aside. `answer` is valid whatever is returned but SACA_BAD_ARGUMENT and
 * SACA_OTHER_VERSION. */
saca_status saca_reflex_step(saca_reflex* reflex, const saca_scene* scene, saca_answer* answer);
/* None came until `time` [s]: everything is carried on likewise. */
saca_status saca_reflex_miss(saca_reflex* reflex, double time, saca_answer* answer);
/* The first rule that the last scene broke, in words; "" where it broke none. */
const char* saca_reflex_broken_rule(const saca_reflex* reflex);

/* Carries the plan of the last answer out: what to tell the car now. Nothing to steer or brake
 * where there is none. On any status but SACA_OK `command` is left alone.
 *
 * dt  since the last call [s], > 0: 1 ms in all that was tested, brakes and path are controlled in
 *     it */
saca_status saca_reflex_control(saca_reflex* reflex, const saca_measured* measured, double dt,
                                saca_command* command);

/* The driver has taken the wheel: what is under way is dropped and this encounter forgotten. It
 * goes on watching, and acts again where somebody still threatens: call it at every scene for as
 * long as he is to keep the wheel. */
saca_status saca_reflex_stand_down(saca_reflex* reflex);

/* A model of the package's car, to try all this without one (docs/architecture.md, vehicle). */
typedef struct saca_model saca_model; /* NOLINT(readability-identifier-naming): likewise */
/* Rolls as the scene's ego does, wheels and actuators settled. The plane outlives it. */
saca_status saca_model_open(const saca_reflex* reflex, const saca_scene* scene, saca_model** model);
void saca_model_close(saca_model* model); /* NULL is fine */
/* dt  in (0, 0.001] [s] */
saca_status saca_model_step(saca_model* model, const saca_command* command, double grip, double dt);
saca_status saca_model_measure(const saca_model* model, saca_measured* measured);

#ifdef __cplusplus
}
#endif

#endif
