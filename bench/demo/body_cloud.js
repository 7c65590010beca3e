// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

// Draws all people in one call: a square for each sphere of each body, on which a shader draws the sphere.

import * as THREE from "three";

const vertexShader = `
uniform sampler2D spheres, people;
uniform int spheresOfBody, rowLength;
out vec2 corner;
flat out vec3 centre, colour;
flat out float radius;
void main() {
  int person = gl_InstanceID / spheresOfBody;
  ivec2 at = ivec2(2 * (person % rowLength), person / rowLength);
  vec4 place = texelFetch(people, at, 0), state = texelFetch(people, at + ivec2(1, 0), 0);
  vec4 sphere = texelFetch(spheres, ivec2(gl_InstanceID % spheresOfBody, int(state.x)), 0);
  vec3 inWorld = vec3(place.z * sphere.x - place.w * sphere.y + place.x, place.w * sphere.x + place.z * sphere.y + place.y, sphere.z);
  centre = (modelViewMatrix * vec4(inWorld, 1.0)).xyz;
  radius = sphere.w;
  colour = state.y > 1.5 ? vec3(0.98, 0.83, 0.25) : state.y > 0.5 ? vec3(0.91, 0.36, 0.20) : mix(vec3(0.36, 0.52, 0.70), vec3(0.50, 0.66, 0.80), state.z);
  corner = 1.2 * position.xy;
  gl_Position = projectionMatrix * vec4(centre + vec3(corner * radius, 0.0), 1.0);
}`;
const fragmentShader = `
uniform mat4 projectionMatrix;
in vec2 corner;
flat in vec3 centre, colour;
flat in float radius;
out vec4 pixel;
void main() {
  // The way of the eye to this point of the square, and where it meets the sphere.
  vec3 way = normalize(centre + vec3(corner * radius, 0.0));
  float along = dot(way, centre), square = along * along - dot(centre, centre) + radius * radius;
  if (square < 0.0) discard;
  vec3 point = way * (along - sqrt(square)), normal = (point - centre) / radius;
  vec4 clip = projectionMatrix * vec4(point, 1.0);
  gl_FragDepth = 0.5 + 0.5 * clip.z / clip.w;
  float light = 0.55 + 0.45 * max(0.0, dot(normal, normalize(vec3(0.4, 0.8, 0.6))));
  pixel = vec4(colour * light, 1.0);
}`;

function floats(values, width, height) {
  const texture = new THREE.DataTexture(values, width, height, THREE.RGBAFormat, THREE.FloatType);
  texture.needsUpdate = true;
  return texture;
}

/** A mesh of `people`, whose poses have the given spheres. */
export class BodyCloud extends THREE.Mesh {
  constructor(spheresOfPoses, people) {
    const count = Math.max(...spheresOfPoses.map((spheres) => spheres.length / 4));
    const spheres = new Float32Array(4 * count * spheresOfPoses.length);
    spheresOfPoses.forEach((of, pose) => spheres.set(of, 4 * count * pose));
    const rowLength = 512, rows = Math.ceil(people.count / rowLength);
    const geometry = new THREE.InstancedBufferGeometry();
    geometry.setAttribute("position", new THREE.Float32BufferAttribute([-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0], 3));
    geometry.setIndex([0, 1, 2, 0, 2, 3]);
    geometry.instanceCount = count * people.count;
    const table = floats(new Float32Array(8 * rowLength * rows), 2 * rowLength, rows);
    super(
      geometry,
      new THREE.RawShaderMaterial({
        glslVersion: THREE.GLSL3,
        vertexShader: `precision highp float; precision highp int; precision highp sampler2D;
          uniform mat4 modelViewMatrix, projectionMatrix; in vec3 position;${vertexShader}`,
        fragmentShader: `precision highp float;${fragmentShader}`,
        uniforms: {
          spheres: { value: floats(spheres, count, spheresOfPoses.length) },
          people: { value: table },
          spheresOfBody: { value: count },
          rowLength: { value: rowLength },
        },
      }),
    );
    this.frustumCulled = false;
    this.people = people;
    this.table = table;
  }

  /** Shows people as they are now. */
  show(collides) {
    const { people, table } = this;
    const { x, y, heading } = people.agents, half = people.side / 2;
    for (let i = 0, at = 0; i < people.count; ++i, at += 8) {
      const values = [x[i] - half, y[i] - half, Math.cos(heading[i]), Math.sin(heading[i]), people.pose(i), i === people.held ? 2 : collides[i], (i * 0.618) % 1, 0];
      table.image.data.set(values, at);
    }
    table.needsUpdate = true;
  }

  dispose() {
    for (const uniform of ["spheres", "people"]) this.material.uniforms[uniform].value.dispose();
    this.geometry.dispose(), this.material.dispose();
  }
}
