// Copyright (c) Larkspur Games. All rights reserved.
// For a Custom node:  return HashedMaskThreshold(MakeMaskInput(Parameters, Scale));
#pragma once

#include "/Engine/Private/Common.ush"
#include "/Engine/Private/Random.ush"

#ifndef MATERIALBLENDING_MASKED
#define MATERIALBLENDING_MASKED 0
#endif

#define UE_DDX(v) ddx(v)
#define UE_DDY(v) ddy(v)

struct FMaskInput
{
	float3 LocalPosition;
	float HashScale;
};

FMaskInput MakeMaskInput(FMaterialPixelParameters Parameters, float Scale)
{
	FMaskInput Input;
	Input.LocalPosition = GetLocalPosition(Parameters);
	Input.HashScale = Scale;
	return Input;
}

float MaskHash(float2 V)
{
	return frac(1.0e4f * sin(17.0f * V.x + 0.1f * V.y) * (0.1f + abs(sin(13.0f * V.y + V.x))));
}

float MaskHash3(float3 V)
{
	return MaskHash(float2(MaskHash(V.xy), V.z));
}

float HashedMaskThreshold(FMaskInput In)
{
	const float MaxDeriv = max(length(UE_DDX(In.LocalPosition)), length(UE_DDY(In.LocalPosition)));
	const float PixScale = 1.0f / (In.HashScale * MaxDeriv);

	// Log-discretized scales
	const float2 PixScales = float2(exp2(floor(log2(PixScale))), exp2(ceil(log2(PixScale))));
	const float2 Alpha = float2(
		MaskHash3(floor(PixScales.x * In.LocalPosition)),
		MaskHash3(floor(PixScales.y * In.LocalPosition)));

	const float LerpFactor = frac(log(PixScale));
	const float X = lerp(Alpha.x, Alpha.y, LerpFactor);

	const float A = min(LerpFactor, 1.0f - LerpFactor);
	const float3 Cases = float3(
		X * X / (2.0f * A * (1.0f - A)),
		(X - 0.5f * A) / (1.0f - A),
		1.0f - ((1.0f - X) * (1.0f - X) / (2.0f * A * (1.0f - A))));

	const float Tau = (X < (1.0f - A)) ? ((X < A) ? Cases.x : Cases.y) : Cases.z;
	return clamp(Tau, 1.0e-6f, 1.0f);
}

#if MATERIALBLENDING_MASKED
void ClipHashed(FMaterialPixelParameters Parameters, FPixelMaterialInputs PixelMaterialInputs)
{
	const float Opacity = GetMaterialMaskInputRaw(PixelMaterialInputs);
	clip(Opacity - HashedMaskThreshold(MakeMaskInput(Parameters, 1.0f)));
}
#endif

float DitherTemporal(float2 SvPosition, uint FrameIndex)
{
	return InterleavedGradientNoise(SvPosition, FrameIndex & 7u) - 0.5f;
}
