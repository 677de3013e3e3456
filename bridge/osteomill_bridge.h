/* The arm's side of the bridge between a haptic arm and haptic_server --device bridge: open, exchange, close.
 *
 * One header, C99, no dependencies; C++ takes it, too. POSIX and Windows (link with ws2_32). Include it before
 * other headers where the compiler hides what is not C (gcc -std=c99). Nothing here starts a thread,
 * waits, or allocates. An arm's program calls omb_exchange() about a thousand times a second from the thread that
 * serves the arm, and gives the arm the force that comes back:
 *
 *     omb_link link;
 *     if (omb_open(&link, "unix:/tmp/osteomill.sock", NULL, &arm) != 0) { puts(link.error); return 1; }
 *     for (;;) {
 *         read_the_arm(&pose);
 *         omb_exchange(&link, &pose, &force);
 *         give_the_arm(force.force_n, force.torque_n_mm);
 *     }
 *     omb_close(&link);
 *
 * The force that comes back is safe by itself: the server's last force is held for 5 ms, then fades, and is zero 50 ms
 * after the server's last message; it is within the arm's force and slew, and finite. The messages:
 * docs/device-bridge.md.
 *
 * Device space is the arm's own, right-handed, in mm; the server's scene says where the patient is in it.
 */
#ifndef OSTEOMILL_BRIDGE_H
#define OSTEOMILL_BRIDGE_H

#if !defined(_WIN32) && !defined(_POSIX_C_SOURCE)
#define _POSIX_C_SOURCE 200112L
#endif
#if defined(_WIN32) && !defined(_CRT_RAND_S)
#define _CRT_RAND_S
#endif

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef _WIN32
#include <winsock2.h>
#include <ws2tcpip.h>
#include <windows.h>
typedef SOCKET omb_socket;
#define OMB_NO_SOCKET INVALID_SOCKET
#else
#include <fcntl.h>
#include <netdb.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <sys/un.h>
#include <time.h>
#include <unistd.h>
typedef int omb_socket;
#define OMB_NO_SOCKET (-1)
#endif

/* ---- Types ------------------------------------------------------------------------------------------------- */

#define OMB_MAGIC 0x424d534fu /* "OSMB" on the wire */
#define OMB_VERSION 1u
#define OMB_MESSAGE_BYTES 192
#define OMB_TAG_BYTES 16
#define OMB_NAME_BYTES 16

typedef enum omb_kind { OMB_HELLO = 1, OMB_WELCOME = 2, OMB_POSE = 3, OMB_FORCE = 4, OMB_GOODBYE = 5 } omb_kind;

/* The header of every message: who sends it in which session, and when by the sender's clock. */
typedef struct omb_header {
    uint16_t kind;
    uint64_t session;  /* the server's, from its welcome; 0 in a hello */
    uint64_t sequence; /* 1, then at least one more each time; either side counts its own */
    uint64_t clock_ns;
} omb_header;

/* The arm's description. All lengths and forces in device space. */
typedef struct omb_arm {
    char name[OMB_NAME_BYTES];       /* ends with a zero unless it is 16 bytes long */
    double max_force_n;              /* that it can give all the time */
    double max_torque_n_mm;          /* 0: it has no actuated rotations */
    double max_stiffness_n_per_mm;   /* of a spring that it renders stably with no delay but its own */
    double apparent_mass_kg;
    double position_step_mm;         /* resolution of a reading; 0: negligible */
    double workspace_min_mm[3];
    double workspace_max_mm[3];
    double tool_from_handle_mm[3];   /* the burr's centre from omb_pose's point, in the handle's frame */
    double max_slew_n_per_s;         /* kept here, not sent; 0: 1000 */
} omb_arm;

typedef enum omb_button { OMB_PEDAL = 1u, OMB_NEXT_BURR = 2u } omb_button;

typedef enum omb_status {
    OMB_READY = 1u,          /* calibrated and held: force may act */
    OMB_HAS_VELOCITY = 2u,   /* else the server makes its own estimate */
    OMB_HAS_ORIENTATION = 4u /* else the spindle stays as the scene has it */
} omb_status;

typedef struct omb_pose {
    double position_mm[3];
    double quaternion[4]; /* w, x, y, z: from the handle's frame (z from the burr's tip to the shank) to device space */
    double velocity_mm_per_s[3];
    uint32_t buttons;
    uint32_t status;
    /* Filled by omb_exchange() from the newest force message, so that the server can measure the delay. */
    uint64_t echo_sequence;
    uint64_t echo_clock_ns; /* as it stood in that message */
    uint64_t kept_ns;       /* from its arrival to this pose */
} omb_pose;

typedef struct omb_force {
    double force_n[3];
    double torque_n_mm[3]; /* on the hand, about the point of omb_pose; zero if the arm gives none */
    uint32_t is_off;       /* the "hold" flag: the server renders nothing now (paused, or a fault); force is zero */
    uint64_t echo_sequence; /* of the pose that this answers */
    uint64_t echo_clock_ns;
} omb_force;

/* ---- Numbers, little endian -------------------------------------------------------------------------------- */

static inline void omb_put(uint8_t* to, uint64_t value, int bytes) {
    int i;
    for (i = 0; i < bytes; ++i) to[i] = (uint8_t)(value >> (8 * i));
}

static inline uint64_t omb_get(const uint8_t* from, int bytes) {
    uint64_t value = 0;
    int i;
    for (i = 0; i < bytes; ++i) value |= (uint64_t)from[i] << (8 * i);
    return value;
}

static inline void omb_put_reals(uint8_t* to, const double* values, int count) {
    int i;
    for (i = 0; i < count; ++i) {
        uint64_t bits;
        memcpy(&bits, &values[i], 8);
        omb_put(to + 8 * i, bits, 8);
    }
}

static inline void omb_get_reals(const uint8_t* from, double* values, int count) {
    int i;
    for (i = 0; i < count; ++i) {
        const uint64_t bits = omb_get(from + 8 * i, 8);
        memcpy(&values[i], &bits, 8);
    }
}

/* ---- SHA-256 and HMAC (FIPS 180-4, RFC 2104) --------------------------------------------------------------- */

typedef struct omb_sha256 {
    uint32_t state[8];
    uint64_t bytes;
    uint8_t block[64];
} omb_sha256;

static inline uint32_t omb_turn(uint32_t x, int by) { return (x >> by) | (x << (32 - by)); }

static inline void omb_sha256_block(uint32_t state[8], const uint8_t block[64]) {
    static const uint32_t k[64] = {
        0x428a2f98u, 0x71374491u, 0xb5c0fbcfu, 0xe9b5dba5u, 0x3956c25bu, 0x59f111f1u, 0x923f82a4u, 0xab1c5ed5u,
        0xd807aa98u, 0x12835b01u, 0x243185beu, 0x550c7dc3u, 0x72be5d74u, 0x80deb1feu, 0x9bdc06a7u, 0xc19bf174u,
        0xe49b69c1u, 0xefbe4786u, 0x0fc19dc6u, 0x240ca1ccu, 0x2de92c6fu, 0x4a7484aau, 0x5cb0a9dcu, 0x76f988dau,
        0x983e5152u, 0xa831c66du, 0xb00327c8u, 0xbf597fc7u, 0xc6e00bf3u, 0xd5a79147u, 0x06ca6351u, 0x14292967u,
        0x27b70a85u, 0x2e1b2138u, 0x4d2c6dfcu, 0x53380d13u, 0x650a7354u, 0x766a0abbu, 0x81c2c92eu, 0x92722c85u,
        0xa2bfe8a1u, 0xa81a664bu, 0xc24b8b70u, 0xc76c51a3u, 0xd192e819u, 0xd6990624u, 0xf40e3585u, 0x106aa070u,
        0x19a4c116u, 0x1e376c08u, 0x2748774cu, 0x34b0bcb5u, 0x391c0cb3u, 0x4ed8aa4au, 0x5b9cca4fu, 0x682e6ff3u,
        0x748f82eeu, 0x78a5636fu, 0x84c87814u, 0x8cc70208u, 0x90befffau, 0xa4506cebu, 0xbef9a3f7u, 0xc67178f2u};
    uint32_t w[64];
    uint32_t a = state[0], b = state[1], c = state[2], d = state[3];
    uint32_t e = state[4], f = state[5], g = state[6], h = state[7];
    int i;
    for (i = 0; i < 16; ++i)
        w[i] = (uint32_t)block[4 * i] << 24 | (uint32_t)block[4 * i + 1] << 16 | (uint32_t)block[4 * i + 2] << 8 |
               (uint32_t)block[4 * i + 3];
    for (i = 16; i < 64; ++i) {
        const uint32_t x = w[i - 15], y = w[i - 2];
        w[i] = w[i - 16] + (omb_turn(x, 7) ^ omb_turn(x, 18) ^ (x >> 3)) + w[i - 7] +
               (omb_turn(y, 17) ^ omb_turn(y, 19) ^ (y >> 10));
    }
    for (i = 0; i < 64; ++i) {
        const uint32_t s1 = omb_turn(e, 6) ^ omb_turn(e, 11) ^ omb_turn(e, 25);
        const uint32_t t1 = h + s1 + ((e & f) ^ (~e & g)) + k[i] + w[i];
        const uint32_t s0 = omb_turn(a, 2) ^ omb_turn(a, 13) ^ omb_turn(a, 22);
        const uint32_t t2 = s0 + ((a & b) ^ (a & c) ^ (b & c));
        h = g;
        g = f;
        f = e;
        e = d + t1;
        d = c;
        c = b;
        b = a;
        a = t1 + t2;
    }
    state[0] += a;
    state[1] += b;
    state[2] += c;
    state[3] += d;
    state[4] += e;
    state[5] += f;
    state[6] += g;
    state[7] += h;
}

static inline void omb_sha256_begin(omb_sha256* sha) {
    static const uint32_t first[8] = {0x6a09e667u, 0xbb67ae85u, 0x3c6ef372u, 0xa54ff53au,
                                      0x510e527fu, 0x9b05688cu, 0x1f83d9abu, 0x5be0cd19u};
    memcpy(sha->state, first, sizeof first);
    sha->bytes = 0;
}

static inline void omb_sha256_add(omb_sha256* sha, const uint8_t* data, size_t bytes) {
    while (bytes > 0) {
        const size_t at = sha->bytes % 64;
        const size_t part = bytes < 64 - at ? bytes : 64 - at;
        memcpy(sha->block + at, data, part);
        sha->bytes += part;
        data += part;
        bytes -= part;
        if (at + part == 64) omb_sha256_block(sha->state, sha->block);
    }
}

static inline void omb_sha256_end(omb_sha256* sha, uint8_t digest[32]) {
    static const uint8_t padding[64] = {0x80};
    const uint64_t bits = 8 * sha->bytes;
    uint8_t length[8];
    int i;
    omb_sha256_add(sha, padding, (sha->bytes % 64 < 56 ? 56 : 120) - sha->bytes % 64);
    for (i = 0; i < 8; ++i) length[i] = (uint8_t)(bits >> (56 - 8 * i));
    omb_sha256_add(sha, length, 8);
    for (i = 0; i < 32; ++i) digest[i] = (uint8_t)(sha->state[i / 4] >> (24 - 8 * (i % 4)));
}

/* A secret that both ends read from a file: 32 bytes at least. */
typedef struct omb_key {
    int is_given;
    omb_sha256 inner, outer; /* behind the first block of each, which is the key's alone */
} omb_key;

static inline void omb_set_key(omb_key* key, const uint8_t* secret, size_t bytes) {
    uint8_t block[64] = {0}, pad[64];
    int i;
    memset(key, 0, sizeof *key);
    key->is_given = 1;
    if (bytes > 64) {
        omb_sha256 sha;
        omb_sha256_begin(&sha);
        omb_sha256_add(&sha, secret, bytes);
        omb_sha256_end(&sha, block);
    } else {
        memcpy(block, secret, bytes);
    }
    for (i = 0; i < 64; ++i) pad[i] = block[i] ^ 0x36;
    omb_sha256_begin(&key->inner);
    omb_sha256_add(&key->inner, pad, 64);
    for (i = 0; i < 64; ++i) pad[i] = block[i] ^ 0x5c;
    omb_sha256_begin(&key->outer);
    omb_sha256_add(&key->outer, pad, 64);
}

static inline void omb_hmac(const omb_key* key, const uint8_t* data, size_t bytes, uint8_t digest[32]) {
    omb_sha256 sha = key->inner;
    uint8_t inner[32];
    omb_sha256_add(&sha, data, bytes);
    omb_sha256_end(&sha, inner);
    sha = key->outer;
    omb_sha256_add(&sha, inner, 32);
    omb_sha256_end(&sha, digest);
}

/* ---- Messages: 32 bytes of header, 144 of body, 16 of tag -------------------------------------------------- */

/* The tag, last: the first 16 bytes of the HMAC of all before it; zeros without a key. */
static inline void omb_seal(uint8_t message[OMB_MESSAGE_BYTES], const omb_key* key) {
    uint8_t digest[32] = {0};
    if (key->is_given) omb_hmac(key, message, OMB_MESSAGE_BYTES - OMB_TAG_BYTES, digest);
    memcpy(message + OMB_MESSAGE_BYTES - OMB_TAG_BYTES, digest, OMB_TAG_BYTES);
}

/* Begins a message: all zero but the header. */
static inline void omb_put_header(uint8_t message[OMB_MESSAGE_BYTES], const omb_header* header) {
    memset(message, 0, OMB_MESSAGE_BYTES);
    omb_put(message, OMB_MAGIC, 4);
    omb_put(message + 4, OMB_VERSION, 2);
    omb_put(message + 6, header->kind, 2);
    omb_put(message + 8, header->session, 8);
    omb_put(message + 16, header->sequence, 8);
    omb_put(message + 24, header->clock_ns, 8);
}

/* 1 and the header, for a message of this protocol and of that key; else 0. */
static inline int omb_get_header(const uint8_t* message, size_t bytes, const omb_key* key, omb_header* header) {
    uint8_t sealed[OMB_MESSAGE_BYTES];
    uint8_t differs = 0;
    int i;
    if (bytes != OMB_MESSAGE_BYTES || omb_get(message, 4) != OMB_MAGIC || omb_get(message + 4, 2) != OMB_VERSION)
        return 0;
    memcpy(sealed, message, OMB_MESSAGE_BYTES);
    omb_seal(sealed, key);
    for (i = OMB_MESSAGE_BYTES - OMB_TAG_BYTES; i < OMB_MESSAGE_BYTES; ++i)
        differs |= (uint8_t)(sealed[i] ^ message[i]); /* always all of them: tells nothing by its time */
    if (differs) return 0;
    header->kind = (uint16_t)omb_get(message + 6, 2);
    header->session = omb_get(message + 8, 8);
    header->sequence = omb_get(message + 16, 8);
    header->clock_ns = omb_get(message + 24, 8);
    return 1;
}

/* A hello says what the arm is, and a number of its own that the welcome repeats. */
static inline void omb_put_hello(uint8_t message[OMB_MESSAGE_BYTES], uint64_t nonce, const omb_arm* arm) {
    uint8_t* body = message + 32;
    omb_put(body, nonce, 8);
    memcpy(body + 8, arm->name, OMB_NAME_BYTES);
    omb_put_reals(body + 24, &arm->max_force_n, 1);
    omb_put_reals(body + 32, &arm->max_torque_n_mm, 1);
    omb_put_reals(body + 40, &arm->max_stiffness_n_per_mm, 1);
    omb_put_reals(body + 48, &arm->apparent_mass_kg, 1);
    omb_put_reals(body + 56, &arm->position_step_mm, 1);
    omb_put_reals(body + 64, arm->workspace_min_mm, 3);
    omb_put_reals(body + 88, arm->workspace_max_mm, 3);
    omb_put_reals(body + 112, arm->tool_from_handle_mm, 3);
}

static inline uint64_t omb_get_hello(const uint8_t message[OMB_MESSAGE_BYTES], omb_arm* arm) {
    const uint8_t* body = message + 32;
    memcpy(arm->name, body + 8, OMB_NAME_BYTES);
    omb_get_reals(body + 24, &arm->max_force_n, 1);
    omb_get_reals(body + 32, &arm->max_torque_n_mm, 1);
    omb_get_reals(body + 40, &arm->max_stiffness_n_per_mm, 1);
    omb_get_reals(body + 48, &arm->apparent_mass_kg, 1);
    omb_get_reals(body + 56, &arm->position_step_mm, 1);
    omb_get_reals(body + 64, arm->workspace_min_mm, 3);
    omb_get_reals(body + 88, arm->workspace_max_mm, 3);
    omb_get_reals(body + 112, arm->tool_from_handle_mm, 3);
    arm->max_slew_n_per_s = 0.0;
    return omb_get(body, 8);
}

/* A welcome's header has the session; its body only repeats the nonce of the hello. */
static inline void omb_put_welcome(uint8_t message[OMB_MESSAGE_BYTES], uint64_t nonce) {
    omb_put(message + 32, nonce, 8);
}

static inline uint64_t omb_get_welcome(const uint8_t message[OMB_MESSAGE_BYTES]) { return omb_get(message + 32, 8); }

static inline void omb_put_pose(uint8_t message[OMB_MESSAGE_BYTES], const omb_pose* pose) {
    uint8_t* body = message + 32;
    omb_put_reals(body, pose->position_mm, 3);
    omb_put_reals(body + 24, pose->quaternion, 4);
    omb_put_reals(body + 56, pose->velocity_mm_per_s, 3);
    omb_put(body + 80, pose->buttons, 4);
    omb_put(body + 84, pose->status, 4);
    omb_put(body + 88, pose->echo_sequence, 8);
    omb_put(body + 96, pose->echo_clock_ns, 8);
    omb_put(body + 104, pose->kept_ns, 8);
}

static inline void omb_get_pose(const uint8_t message[OMB_MESSAGE_BYTES], omb_pose* pose) {
    const uint8_t* body = message + 32;
    omb_get_reals(body, pose->position_mm, 3);
    omb_get_reals(body + 24, pose->quaternion, 4);
    omb_get_reals(body + 56, pose->velocity_mm_per_s, 3);
    pose->buttons = (uint32_t)omb_get(body + 80, 4);
    pose->status = (uint32_t)omb_get(body + 84, 4);
    pose->echo_sequence = omb_get(body + 88, 8);
    pose->echo_clock_ns = omb_get(body + 96, 8);
    pose->kept_ns = omb_get(body + 104, 8);
}

static inline void omb_put_force(uint8_t message[OMB_MESSAGE_BYTES], const omb_force* force) {
    uint8_t* body = message + 32;
    omb_put_reals(body, force->force_n, 3);
    omb_put_reals(body + 24, force->torque_n_mm, 3);
    omb_put(body + 48, force->is_off, 4);
    omb_put(body + 56, force->echo_sequence, 8);
    omb_put(body + 64, force->echo_clock_ns, 8);
}

static inline void omb_get_force(const uint8_t message[OMB_MESSAGE_BYTES], omb_force* force) {
    const uint8_t* body = message + 32;
    omb_get_reals(body, force->force_n, 3);
    omb_get_reals(body + 24, force->torque_n_mm, 3);
    force->is_off = (uint32_t)omb_get(body + 48, 4);
    force->echo_sequence = omb_get(body + 56, 8);
    force->echo_clock_ns = omb_get(body + 64, 8);
}

/* ---- The force on the hand --------------------------------------------------------------------------------- */

#define OMB_HOLD_NS 5000000u      /* so long the last force is kept without a word from the server */
#define OMB_SILENT_NS 50000000u   /* after so long it is zero */
#define OMB_GONE_NS 250000000u    /* after so long the server is asked anew who it is */
#define OMB_HELLO_EVERY_NS 20000000u
#define OMB_RELEASE_S 0.012 /* what is still given then, after this process itself stood still, goes in so long */
#define OMB_RETURN_S 0.1 /* a force that was off comes back over so long */

/* Without libm. 0 for anything but a positive number. */
static inline double omb_sqrt(double x) {
    double root = x > 1.0 ? x : 1.0;
    int i;
    if (!(x > 0.0) || x > 1e200) return 0.0;
    for (i = 0; i < 400 && root * root > x * (1.0 + 1e-14); ++i) root = 0.5 * (root + x / root);
    return root;
}

static inline double omb_length(const double v[3]) { return omb_sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

/* Shortens `v` to `most`; zero where one of its numbers is none. */
static inline void omb_clamp(double v[3], double most) {
    const double squared = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    int i;
    if (!(squared < 1e200)) {
        v[0] = v[1] = v[2] = 0.0;
    } else if (squared > most * most) {
        const double scale = most / omb_length(v);
        for (i = 0; i < 3; ++i) v[i] *= scale;
    }
}

/* The quaternion of a rotation matrix, given row by row, whose columns are the handle's axes in device space
 * (Shepperd's choice of the largest, J. Guidance and Control 1:223, 1978). */
static inline void omb_quaternion(const double r[3][3], double quaternion[4]) {
    const double trace = r[0][0] + r[1][1] + r[2][2];
    double scale;
    int i = 0, j, k;
    if (trace > 0.0) {
        scale = 2.0 * omb_sqrt(1.0 + trace);
        quaternion[0] = 0.25 * scale;
        quaternion[1] = (r[2][1] - r[1][2]) / scale;
        quaternion[2] = (r[0][2] - r[2][0]) / scale;
        quaternion[3] = (r[1][0] - r[0][1]) / scale;
        return;
    }
    if (r[1][1] > r[0][0]) i = 1;
    if (r[2][2] > r[i][i]) i = 2;
    j = (i + 1) % 3;
    k = (i + 2) % 3;
    scale = 2.0 * omb_sqrt(1.0 + r[i][i] - r[j][j] - r[k][k]);
    if (!(scale > 0.0)) scale = 1.0; /* no rotation at all; the server refuses what comes of it */
    quaternion[0] = (r[k][j] - r[j][k]) / scale;
    quaternion[1 + i] = 0.25 * scale;
    quaternion[1 + j] = (r[j][i] + r[i][j]) / scale;
    quaternion[1 + k] = (r[k][i] + r[i][k]) / scale;
}

/* The share of a force to render when it answers a pose of that age: 1, falling from 5 ms on, 0 from 50 ms on. */
static inline double omb_trust(uint64_t age_ns) {
    if (age_ns <= OMB_HOLD_NS) return 1.0;
    if (age_ns >= OMB_SILENT_NS) return 0.0;
    return (double)(OMB_SILENT_NS - age_ns) / (double)(OMB_SILENT_NS - OMB_HOLD_NS);
}

/* Moves `given` towards `wanted`, by at most `most_step`. */
static inline void omb_approach(double given[3], const double wanted[3], double most_step) {
    double step[3], length;
    int i;
    for (i = 0; i < 3; ++i) step[i] = wanted[i] - given[i];
    length = omb_length(step);
    for (i = 0; i < 3; ++i) given[i] = length > most_step ? given[i] + step[i] * most_step / length : wanted[i];
}

/* ---- The link ---------------------------------------------------------------------------------------------- */

typedef enum omb_state {
    OMB_SEEKING = 0, /* no server has answered; force is zero */
    OMB_RUNNING = 1,
    OMB_FADING = 2   /* the server has not answered for more than 5 ms */
} omb_state;

typedef struct omb_link {
    omb_socket socket;
    omb_key key;
    omb_arm arm;
    uint64_t nonce;
    uint64_t session; /* 0: none */
    uint64_t sequence;
    uint64_t hello_ns;           /* when it was said last */
    omb_force newest;            /* as the server sent it */
    uint64_t newest_sequence;    /* of that message */
    uint64_t newest_clock_ns;
    uint64_t arrived_ns;
    double trust;                /* 0 to 1: the share of the server's force given last */
    double given_n[3];           /* to the arm, last */
    double given_n_mm[3];
    uint64_t given_ns;
    uint64_t refused;            /* messages of another key, session or protocol */
    uint64_t out_of_order;       /* messages that came twice, or after a newer one */
    char own_path[108];          /* of a Unix socket; else empty */
    char error[160];             /* one line, after omb_open() has failed */
} omb_link;

static inline uint64_t omb_now_ns(void) {
#ifdef _WIN32
    LARGE_INTEGER count, rate;
    QueryPerformanceCounter(&count);
    QueryPerformanceFrequency(&rate);
    return (uint64_t)(count.QuadPart / rate.QuadPart) * 1000000000u +
           (uint64_t)(count.QuadPart % rate.QuadPart) * 1000000000u / (uint64_t)rate.QuadPart;
#else
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (uint64_t)now.tv_sec * 1000000000u + (uint64_t)now.tv_nsec;
#endif
}

/* Nobody can guess it. 0 where the system has none to give. */
static inline uint64_t omb_random(void) {
    uint64_t value = 0;
#ifdef _WIN32
    unsigned int half = 0;
    if (rand_s(&half) == 0) value = half;
    if (rand_s(&half) == 0) value = value << 32 | half;
#else
    FILE* file = fopen("/dev/urandom", "rb");
    if (file == NULL) return 0;
    if (fread(&value, sizeof value, 1, file) != 1) value = 0;
    fclose(file);
#endif
    return value;
}

static inline int omb_fail(omb_link* link, const char* what, const char* which) {
    /* The precision keeps it within the line, whatever it is. */
    snprintf(link->error, sizeof link->error, "%.100s: %.50s", which, what);
    return -1;
}

/* 0, and the key; or -1 with a line in link->error. */
static inline int omb_read_key(omb_link* link, const char* file_name) {
    uint8_t secret[4096];
    size_t bytes;
    FILE* file;
#ifndef _WIN32
    /* A pipe or a device might never end; and a secret that others may read or write is none. */
    struct stat facts;
    if (stat(file_name, &facts) != 0 || !S_ISREG(facts.st_mode))
        return omb_fail(link, "cannot be read", file_name);
    if ((facts.st_mode & (S_IRWXG | S_IRWXO) & ~(facts.st_uid == 0 ? S_IRGRP : 0u)) != 0)
        return omb_fail(link, "others may read it; chmod 600 it", file_name);
#endif
    file = fopen(file_name, "rb");
    if (file == NULL) return omb_fail(link, "cannot be read", file_name);
    bytes = fread(secret, 1, sizeof secret, file);
    fclose(file);
    if (bytes < 32) return omb_fail(link, "a key has 32 bytes at least", file_name);
    if (bytes == sizeof secret) return omb_fail(link, "a key has less than 4096 bytes", file_name);
    omb_set_key(&link->key, secret, bytes);
    return 0;
}

static inline void omb_shut(omb_link* link) {
    if (link->socket == OMB_NO_SOCKET) return;
#ifdef _WIN32
    closesocket(link->socket);
    WSACleanup();
#else
    close(link->socket);
    if (link->own_path[0] != 0) unlink(link->own_path);
#endif
    link->socket = OMB_NO_SOCKET;
}

static inline int omb_does_not_wait(omb_socket socket) {
#ifdef _WIN32
    u_long yes = 1;
    return ioctlsocket(socket, (long)FIONBIO, &yes) == 0;
#else
    return fcntl(socket, F_SETFL, O_NONBLOCK) == 0;
#endif
}

static inline int omb_connect_udp(omb_link* link, const char* address) {
    struct addrinfo wanted, *found = NULL;
    char host[80];
    const char* colon = strrchr(address, ':');
    size_t length = colon == NULL ? 0 : (size_t)(colon - address);
    int is_connected;
    if (length == 0 || length >= sizeof host || colon[1] == 0)
        return omb_fail(link, "must be udp:HOST:PORT", address);
    memcpy(host, address, length);
    host[length] = 0;
    if (host[0] == '[' && host[length - 1] == ']') { /* IPv6 */
        memmove(host, host + 1, length - 2);
        host[length - 2] = 0;
    }
    memset(&wanted, 0, sizeof wanted);
    wanted.ai_socktype = SOCK_DGRAM;
    if (getaddrinfo(host, colon + 1, &wanted, &found) != 0 || found == NULL)
        return omb_fail(link, "is no address", address);
    link->socket = socket(found->ai_family, found->ai_socktype, found->ai_protocol);
    is_connected = link->socket != OMB_NO_SOCKET &&
                   connect(link->socket, found->ai_addr, (socklen_t)found->ai_addrlen) == 0;
    freeaddrinfo(found);
    if (!is_connected) return omb_fail(link, "cannot be reached", address);
    return 0;
}

#ifndef _WIN32
/* The server is answered at a path of our own, beside its. */
static inline int omb_connect_unix(omb_link* link, const char* path) {
    struct sockaddr_un own;
    memset(&own, 0, sizeof own);
    own.sun_family = AF_UNIX;
    if (strlen(path) + 32 > sizeof own.sun_path) return omb_fail(link, "is too long a path", path);
    snprintf(own.sun_path, sizeof own.sun_path, "%s.%lx.%04x", path, (unsigned long)getpid(),
             (unsigned)(link->nonce & 0xffffu));
    link->socket = socket(AF_UNIX, SOCK_DGRAM, 0);
    if (link->socket == OMB_NO_SOCKET) return omb_fail(link, "no socket can be had", path);
    if (bind(link->socket, (const struct sockaddr*)&own, sizeof own) != 0)
        return omb_fail(link, "cannot be answered: no socket can be made beside it", path);
    memcpy(link->own_path, own.sun_path, sizeof own.sun_path);
    return 0;
}

/* Fails while no server listens there; asked again with each hello. */
static inline void omb_find_unix_server(omb_link* link) {
    struct sockaddr_un server;
    char* dot;
    int i;
    memset(&server, 0, sizeof server);
    server.sun_family = AF_UNIX;
    memcpy(server.sun_path, link->own_path, sizeof server.sun_path);
    for (i = 0; i < 2; ++i) {
        dot = strrchr(server.sun_path, '.');
        if (dot != NULL) *dot = 0;
    }
    (void)connect(link->socket, (const struct sockaddr*)&server, sizeof server);
}
#endif

/* Begins to seek the server at "udp:HOST:PORT" or "unix:PATH". `key_file`: the secret that the server has, too; NULL:
 * none, which a server takes from its own machine alone. 0; or -1 with a line in link->error, and nothing open. The
 * server need not be there yet. */
static inline int omb_open(omb_link* link, const char* address, const char* key_file, const omb_arm* arm) {
    int failed;
    memset(link, 0, sizeof *link);
    link->socket = OMB_NO_SOCKET;
    link->arm = *arm;
    if (!(link->arm.max_slew_n_per_s > 0.0)) link->arm.max_slew_n_per_s = 1000.0;
    if (!(link->arm.max_force_n > 0.0)) return omb_fail(link, "must be over 0", "max_force_n");
    if (key_file != NULL && omb_read_key(link, key_file) != 0) return -1;
    link->nonce = omb_random();
    if (link->nonce == 0) return omb_fail(link, "the system has none", "random numbers");
#ifdef _WIN32
    {
        WSADATA data;
        if (WSAStartup(MAKEWORD(2, 2), &data) != 0) return omb_fail(link, "cannot be started", "Winsock");
    }
#endif
    if (strncmp(address, "udp:", 4) == 0)
        failed = omb_connect_udp(link, address + 4);
#ifndef _WIN32
    else if (strncmp(address, "unix:", 5) == 0)
        failed = omb_connect_unix(link, address + 5);
#endif
    else
        failed = omb_fail(link, "must be udp:HOST:PORT or unix:PATH", address);
    if (failed == 0 && !omb_does_not_wait(link->socket)) failed = omb_fail(link, "cannot be made not to wait", address);
    if (failed != 0) omb_shut(link);
    return failed;
}

static inline void omb_say(omb_link* link, const uint8_t message[OMB_MESSAGE_BYTES]) {
    /* A message that cannot be sent now counts as lost on the way. */
    if (send(link->socket, (const char*)message, OMB_MESSAGE_BYTES, 0) < 0) return;
}

static inline void omb_begin(omb_link* link, uint8_t message[OMB_MESSAGE_BYTES], omb_kind kind, uint64_t now_ns) {
    omb_header header;
    header.kind = (uint16_t)kind;
    header.session = link->session;
    header.sequence = ++link->sequence;
    header.clock_ns = now_ns;
    omb_put_header(message, &header);
}

static inline void omb_say_hello(omb_link* link, uint64_t now_ns) {
    uint8_t message[OMB_MESSAGE_BYTES];
    if (link->hello_ns != 0 && now_ns - link->hello_ns < OMB_HELLO_EVERY_NS) return;
    link->hello_ns = now_ns;
#ifndef _WIN32
    if (link->own_path[0] != 0) omb_find_unix_server(link);
#endif
    omb_begin(link, message, OMB_HELLO, now_ns);
    omb_put_hello(message, link->nonce, &link->arm);
    omb_seal(message, &link->key);
    omb_say(link, message);
}

static inline void omb_hear(omb_link* link, const uint8_t* message, size_t bytes, uint64_t now_ns) {
    omb_header header;
    if (!omb_get_header(message, bytes, &link->key, &header)) {
        ++link->refused;
    } else if (header.kind == OMB_WELCOME && link->session == 0 && omb_get_welcome(message) == link->nonce) {
        link->session = header.session;
        link->newest_sequence = header.sequence;
        link->newest_clock_ns = header.clock_ns;
        link->arrived_ns = now_ns;
        memset(&link->newest, 0, sizeof link->newest);
    } else if (header.session != link->session || link->session == 0) {
        ++link->refused;
    } else if (header.sequence <= link->newest_sequence) {
        ++link->out_of_order;
    } else if (header.kind == OMB_FORCE) {
        omb_get_force(message, &link->newest);
        link->newest_sequence = header.sequence;
        link->newest_clock_ns = header.clock_ns;
        link->arrived_ns = now_ns;
    } else if (header.kind == OMB_GOODBYE) {
        link->session = 0;
    }
}

/* For tests with a clock of their own; else omb_exchange(). */
static inline omb_state omb_exchange_at(omb_link* link, const omb_pose* pose, omb_force* force, uint64_t now_ns) {
    uint8_t message[OMB_MESSAGE_BYTES + 1]; /* one more, so that too long a message is noticed */
    double trust = 0.0, step_s, n_per_s, n_mm_per_s;
    uint64_t silent_ns, age_ns;
    int i, left;
    for (left = 64; left > 0; --left) { /* a flood does not keep it for ever */
        const long bytes = (long)recv(link->socket, (char*)message, sizeof message, 0);
        if (bytes < 0) break;
        omb_hear(link, message, (size_t)bytes, now_ns);
    }
    silent_ns = now_ns - link->arrived_ns;
    if (link->session != 0 && silent_ns > OMB_GONE_NS) { /* it may have begun anew: it must know a new nonce */
        const uint64_t fresh = omb_random();
        link->session = 0;
        if (fresh != 0) link->nonce = fresh;
    }
    /* Counted from the pose that it answers, so that a long way is as bad as silence. */
    age_ns = now_ns - link->newest.echo_clock_ns;
    if (link->session == 0) {
        omb_say_hello(link, now_ns);
    } else {
        omb_pose said = *pose;
        said.echo_sequence = link->newest_sequence;
        said.echo_clock_ns = link->newest_clock_ns;
        said.kept_ns = silent_ns;
        omb_begin(link, message, OMB_POSE, now_ns);
        omb_put_pose(message, &said);
        omb_seal(message, &link->key);
        omb_say(link, message);
        if (!link->newest.is_off && (pose->status & OMB_READY)) trust = omb_trust(age_ns);
    }
    /* After a long gap no long step, and while the force goes none longer than of a loop on time. */
    step_s = 1e-9 * (double)(now_ns - link->given_ns);
    if (step_s > (trust < 1.0 ? 0.001 : 0.002)) step_s = trust < 1.0 ? 0.001 : 0.002;
    link->given_ns = now_ns;
    if (trust > link->trust + step_s / OMB_RETURN_S) trust = link->trust + step_s / OMB_RETURN_S;
    link->trust = trust;
    *force = link->newest;
    omb_clamp(force->force_n, link->arm.max_force_n);
    omb_clamp(force->torque_n_mm, link->arm.max_torque_n_mm > 0.0 ? link->arm.max_torque_n_mm : 0.0);
    for (i = 0; i < 3; ++i) {
        force->force_n[i] *= trust;
        force->torque_n_mm[i] *= trust;
    }
    /* While it comes or goes, gently; and to nothing at all where nothing is wanted. */
    n_per_s = trust < 1.0 ? link->arm.max_force_n / OMB_RELEASE_S : link->arm.max_slew_n_per_s;
    n_mm_per_s = trust < 1.0 ? link->arm.max_torque_n_mm / OMB_RELEASE_S : 100.0 * link->arm.max_slew_n_per_s;
    omb_approach(link->given_n, force->force_n, step_s * n_per_s);
    omb_approach(link->given_n_mm, force->torque_n_mm, step_s * n_mm_per_s);
    memcpy(force->force_n, link->given_n, sizeof link->given_n);
    memcpy(force->torque_n_mm, link->given_n_mm, sizeof link->given_n_mm);
    if (link->session == 0) return OMB_SEEKING;
    return age_ns > OMB_HOLD_NS ? OMB_FADING : OMB_RUNNING;
}

/* Says where the arm is and takes what the server wants of it. Returns at once. `force` is what the arm is to give
 * now, whatever has come: zero where nothing has. */
static inline omb_state omb_exchange(omb_link* link, const omb_pose* pose, omb_force* force) {
    return omb_exchange_at(link, pose, force, omb_now_ns());
}

/* Tells the server, so that it need not wait. Give the arm no force any more. */
static inline void omb_close(omb_link* link) {
    uint8_t message[OMB_MESSAGE_BYTES];
    if (link->socket == OMB_NO_SOCKET) return;
    if (link->session != 0) {
        omb_begin(link, message, OMB_GOODBYE, omb_now_ns());
        omb_seal(message, &link->key);
        omb_say(link, message);
    }
    omb_shut(link);
}

#endif
