"""Files that the tests write: images without an image library, calibrations, bags."""
import rosbag
import rospy

import cube_scene


def write_pgm(path, picture):
    with open(path, "wb") as file:
        file.write(b"P5 %d %d 255\n" % (picture.shape[1], picture.shape[0]) + picture.tobytes())


def write_camera_yaml(path, width, height, focal, cx, cy):
    with open(path, "w") as file:
        file.write("""image_width: %d
image_height: %d
camera_name: test
camera_matrix: {rows: 3, cols: 3, data: [%f, 0, %f, 0, %f, %f, 0, 0, 1]}
distortion_model: plumb_bob
distortion_coefficients: {rows: 1, cols: 5, data: [0, 0, 0, 0, 0]}
rectification_matrix: {rows: 3, cols: 3, data: [1, 0, 0, 0, 1, 0, 0, 0, 1]}
projection_matrix: {rows: 3, cols: 4, data: [%f, 0, %f, 0, 0, %f, %f, 0, 0, 0, 1, 0]}
""" % (width, height, focal, cx, focal, cy, focal, cx, focal, cy))


def write_cube_files(folder):
    """cube.pgm and camera.yaml."""
    write_pgm(folder + "/cube.pgm", cube_scene.cube_picture())
    write_camera_yaml(folder + "/camera.yaml", cube_scene.WIDTH, cube_scene.HEIGHT, cube_scene.FOCAL, cube_scene.CX,
                      cube_scene.CY)


def write_cube_bag(path, start, count, period):
    """`count` images of the cube from `start` [s] on, every `period` [s], as a camera in /camera would give them."""
    image, info = cube_scene.image_message(cube_scene.cube_picture()), cube_scene.camera_info()
    with rosbag.Bag(path, "w") as bag:
        for i in range(count):
            stamp = rospy.Time.from_sec(start + i * period)
            image.header.stamp = info.header.stamp = stamp
            bag.write("/camera/camera_info", info, stamp)
            bag.write("/camera/image_raw", image, stamp)
