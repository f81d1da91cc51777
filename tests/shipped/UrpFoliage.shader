Shader "Meadow/Foliage Hashed"
{
    Properties
    {
        [MainTexture] _BaseMap ("Albedo", 2D) = "white" {}
        [MainColor] _BaseColor ("Color", Color) = (1, 1, 1, 1)
        [Normal] _BumpMap ("Normal Map", 2D) = "bump" {}
        _BumpScale ("Normal Scale", Float) = 1.0
        _Smoothness ("Smoothness", Range(0, 1)) = 0.2
        _HashScale ("Noise Size (pixels)", Range(0.1, 4)) = 1
        [Toggle(_HASHED_ALPHA)] _HashedAlpha ("Hashed Alpha", Float) = 1
        _Cutoff ("Alpha Cutoff", Range(0, 1)) = 0.5
    }

    SubShader
    {
        Tags { "RenderType" = "TransparentCutout" "Queue" = "AlphaTest" "RenderPipeline" = "UniversalPipeline" }
        LOD 200
        Cull Off

        HLSLINCLUDE
        #include "Packages/com.unity.render-pipelines.universal/ShaderLibrary/Core.hlsl"

        CBUFFER_START(UnityPerMaterial)
            float4 _BaseMap_ST;
            half4 _BaseColor;
            half _BumpScale;
            half _Smoothness;
            half _Cutoff;
            float _HashScale;
        CBUFFER_END

        TEXTURE2D(_BaseMap);        SAMPLER(sampler_BaseMap);
        TEXTURE2D(_BumpMap);        SAMPLER(sampler_BumpMap);

        float HashAlpha2(float2 v)
        {
            return frac(1.0e4 * sin(17.0 * v.x + 0.1 * v.y) * (0.1 + abs(sin(13.0 * v.y + v.x))));
        }

        float HashAlpha3(float3 v)
        {
            return HashAlpha2(float2(HashAlpha2(v.xy), v.z));
        }

        float HashedAlphaThreshold(float3 positionOS)
        {
            float maxDeriv = max(length(ddx(positionOS)), length(ddy(positionOS)));
            float pixScale = rcp(_HashScale * maxDeriv);
            float2 pixScales = float2(exp2(floor(log2(pixScale))), exp2(ceil(log2(pixScale))));
            float2 alpha = float2(HashAlpha3(floor(pixScales.x * positionOS)), HashAlpha3(floor(pixScales.y * positionOS)));
            float lerpFactor = frac(log2(pixScale));
            float x = lerp(alpha.x, alpha.y, lerpFactor);
            float a = min(lerpFactor, 1.0 - lerpFactor);
            float3 cases = float3(
                x * x / (2.0 * a * (1.0 - a)),
                (x - 0.5 * a) / (1.0 - a),
                1.0 - ((1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a))));
            float t = (x < (1.0 - a)) ? ((x < a) ? cases.x : cases.y) : cases.z;
            return clamp(t, 1.0e-6, 1.0);
        }

        void ApplyCutout(half alpha, float3 positionOS)
        {
        #if defined(_HASHED_ALPHA)
            clip(alpha - HashedAlphaThreshold(positionOS));
        #else
            clip(alpha - _Cutoff);
        #endif
        }
        ENDHLSL

        Pass
        {
            Name "ForwardLit"
            Tags { "LightMode" = "UniversalForward" }
            AlphaToMask Off
            ZWrite On

            HLSLPROGRAM
            #pragma target 3.5
            #pragma vertex Vert
            #pragma fragment Frag
            #pragma shader_feature_local_fragment _HASHED_ALPHA
            #pragma multi_compile _ _MAIN_LIGHT_SHADOWS _MAIN_LIGHT_SHADOWS_CASCADE
            #pragma multi_compile _ _ADDITIONAL_LIGHTS
            #pragma multi_compile_fog
            #pragma multi_compile_instancing
            #include "Packages/com.unity.render-pipelines.universal/ShaderLibrary/Lighting.hlsl"

            struct Attributes
            {
                float4 positionOS : POSITION;
                float3 normalOS   : NORMAL;
                float4 tangentOS  : TANGENT;
                float2 uv         : TEXCOORD0;
                UNITY_VERTEX_INPUT_INSTANCE_ID
            };

            struct Varyings
            {
                float4 positionCS : SV_POSITION;
                float2 uv         : TEXCOORD0;
                float3 positionOS : TEXCOORD1;
                float3 positionWS : TEXCOORD2;
                half3 normalWS    : TEXCOORD3;
                half fogFactor    : TEXCOORD4;
                UNITY_VERTEX_INPUT_INSTANCE_ID
                UNITY_VERTEX_OUTPUT_STEREO
            };

            Varyings Vert(Attributes IN)
            {
                Varyings OUT = (Varyings)0;
                UNITY_SETUP_INSTANCE_ID(IN);
                UNITY_TRANSFER_INSTANCE_ID(IN, OUT);
                UNITY_INITIALIZE_VERTEX_OUTPUT_STEREO(OUT);
                VertexPositionInputs pos = GetVertexPositionInputs(IN.positionOS.xyz);
                OUT.positionCS = pos.positionCS;
                OUT.positionWS = pos.positionWS;
                OUT.positionOS = IN.positionOS.xyz;
                OUT.normalWS = TransformObjectToWorldNormal(IN.normalOS);
                OUT.uv = TRANSFORM_TEX(IN.uv, _BaseMap);
                OUT.fogFactor = ComputeFogFactor(pos.positionCS.z);
                return OUT;
            }

            half4 Frag(Varyings IN, half facing : VFACE) : SV_Target
            {
                UNITY_SETUP_INSTANCE_ID(IN);
                half4 albedo = SAMPLE_TEXTURE2D(_BaseMap, sampler_BaseMap, IN.uv) * _BaseColor;
                ApplyCutout(albedo.a, IN.positionOS);

                half3 n = normalize(IN.normalWS) * (facing > 0 ? 1 : -1);
                Light mainLight = GetMainLight(TransformWorldToShadowCoord(IN.positionWS));
                half3 lighting = SampleSH(n) + mainLight.color * mainLight.shadowAttenuation * saturate(dot(n, mainLight.direction));

            #if defined(_ADDITIONAL_LIGHTS)
                uint count = GetAdditionalLightsCount();
                for (uint i = 0u; i < count; ++i)
                {
                    Light light = GetAdditionalLight(i, IN.positionWS);
                    lighting += light.color * light.distanceAttenuation * saturate(dot(n, light.direction));
                }
            #endif

                half3 color = MixFog(albedo.rgb * lighting, IN.fogFactor);
                return half4(color, 1);
            }
            ENDHLSL
        }

        Pass
        {
            Name "ShadowCaster"
            Tags { "LightMode" = "ShadowCaster" }
            ColorMask 0

            HLSLPROGRAM
            #pragma vertex ShadowVert
            #pragma fragment ShadowFrag
            #pragma shader_feature_local_fragment _HASHED_ALPHA

            struct ShadowVaryings
            {
                float4 positionCS : SV_POSITION;
                float2 uv : TEXCOORD0;
                float3 positionOS : TEXCOORD1;
            };

            ShadowVaryings ShadowVert(float4 positionOS : POSITION, float2 uv : TEXCOORD0)
            {
                ShadowVaryings OUT;
                OUT.positionCS = TransformObjectToHClip(positionOS.xyz);
                OUT.positionOS = positionOS.xyz;
                OUT.uv = TRANSFORM_TEX(uv, _BaseMap);
                return OUT;
            }

            half4 ShadowFrag(ShadowVaryings IN) : SV_Target
            {
                half alpha = SAMPLE_TEXTURE2D(_BaseMap, sampler_BaseMap, IN.uv).a * _BaseColor.a;
                ApplyCutout(alpha, IN.positionOS);
                return 0;
            }
            ENDHLSL
        }
    }
    FallBack "Hidden/Universal Render Pipeline/FallbackError"
}
