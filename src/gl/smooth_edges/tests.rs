use super::*;

const SIZE: Size = Size { width: 200, height: 100 };

#[test]
fn a_lines_square_holds_the_line_and_what_it_fades_over() {
    let ends = [Vec4::new(-1.0, 0.0, 0.5, 2.0), Vec4::new(0.5, 0.5, 0.0, 1.0)];
    let Corners { places, firsts, seconds } = lines([ends].into_iter(), SIZE, 6.0);
    assert!(places.iter().all(|[.., w]| *w == 1.0), "even on the screen");
    assert_eq!((firsts, seconds), (vec![[50.0, 50.0, 2.0]; 4], vec![[150.0, 75.0, 1.0]; 4]));
    let pixels: Vec<Vec2> = places.iter().map(|[x, y, ..]| (Vec2::new(*x, *y) + 1.0) * half_size(SIZE)).collect();
    let length = 100.0f32.hypot(25.0);
    assert!(((pixels[3] - pixels[0]).length() - 8.0).abs() < 1e-3);
    assert!(((pixels[1] - pixels[0]).length() - length - 2.0).abs() < 1e-3);
    assert!((pixels[1] - pixels[0]).dot(pixels[3] - pixels[0]).abs() < 1e-2, "its ends are square");
}

#[test]
fn what_is_before_the_eye_is_not_drawn() {
    let before = Vec4::new(4.0, 0.0, -3.0, 1.0);
    assert_eq!(lines([[before, before]].into_iter(), SIZE, 2.0), Corners::default());
    assert_eq!(points([before].into_iter(), SIZE, 2.0), Corners::default());
    let [x, y, ..] = points([Vec4::W].into_iter(), SIZE, 9.0).places[2];
    assert!((x - 0.05).abs() < 1e-6 && (y - 0.1).abs() < 1e-6);
}
