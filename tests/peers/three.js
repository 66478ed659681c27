// SPDX-License-Identifier: MIT
// What three.js makes of a GLB (base64 in window.GLB): draws it by its first camera, or from before it, and tells what it has as the title.
import * as THREE from 'three';
import {GLTFLoader} from 'three/examples/jsm/loaders/GLTFLoader.js';

const renderer = new THREE.WebGLRenderer({preserveDrawingBuffer: true});
renderer.setSize(800, 600);
document.body.style.margin = 0;
document.body.append(renderer.domElement);
const bytes = Uint8Array.from(atob(window.GLB), c => c.charCodeAt(0)).buffer;
new GLTFLoader().parse(bytes, '', gltf => {
  const scene = new THREE.Scene();
  scene.add(gltf.scene);
  scene.updateMatrixWorld(true);
  let camera = gltf.cameras[0];
  if (!camera) {
    const box = new THREE.Box3().setFromObject(scene), middle = box.getCenter(new THREE.Vector3()), size = box.getSize(new THREE.Vector3()).length();
    camera = new THREE.PerspectiveCamera(45, 4 / 3, 0.01 * size, 10 * size);
    camera.position.set(middle.x + 0.2 * size, middle.y + 0.3 * size, middle.z + size);
    camera.lookAt(middle);
    camera.updateMatrixWorld();
  }
  renderer.render(scene, camera);
  const meshes = [];
  scene.traverse(o => { if (o.isMesh) { meshes.push(Object.keys(o.geometry.attributes).join('+') + ' ' + o.material.type); } });
  document.title = `${meshes.length} meshes (${[...new Set(meshes)].join(', ')}), ${gltf.cameras.length} cameras`;
}, error => { document.title = 'ERROR ' + error; });
