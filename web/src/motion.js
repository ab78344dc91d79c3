// Whether the system asks for little motion: then the camera jumps, and nothing begins to play by itself.

const asked = window.matchMedia("(prefers-reduced-motion: reduce)");

export const calm = () => asked.matches;
